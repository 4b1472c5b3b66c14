// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/landscape/path_projection.h"

#include <algorithm>
#include <cmath>

namespace icpscape {

PathProjection ProjectOntoPath(const Path& path, const SE3d& T, double u_min, double u_max,
                               double rotation_length_m) {
  constexpr int kIntervals = 100;
  constexpr int kZooms = 10;  // Each to a fiftieth: 50^-10 is below rounding.
  const auto at = [&](double u) {
    const SE3d T_u = path.Pose(u);
    return PathProjection{u, (path.PlaceOfSensor(T) - path.PlaceOfSensor(T_u)).norm(),
                          (T_u.Inverse() * T).LogRotation().norm()};
  };
  const auto distance = [&](const PathProjection& p) {
    return std::hypot(p.off_path_m, rotation_length_m * p.off_path_rad);
  };
  PathProjection best = at(u_min);
  double low = u_min, high = u_max;
  for (int zoom = 0; zoom < kZooms; ++zoom) {
    const double step = (high - low) / kIntervals;
    for (int i = 0; i <= kIntervals; ++i) {
      const PathProjection p = at(i == kIntervals ? high : low + i * step);
      if (distance(p) < distance(best)) {
        best = p;
      }
    }
    low = std::max(u_min, best.u - step);
    high = std::min(u_max, best.u + step);
  }
  return best;
}

}  // namespace icpscape
