// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/ego_blind_spot.h"

#include <cmath>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

// 1 where a point lies outside the vertical cylinder.
std::vector<char> KeepOutside(const PointCloud& cloud, const Vec3& center, double radius_m) {
  if (!(radius_m > 0) || !std::isfinite(radius_m)) {
    throw UsageError("the blind spot's radius is " + Number(radius_m) +
                     " m; expected a length above 0.");
  }
  std::vector<char> keep(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double dx = cloud.x[i] - center.x();
    const double dy = cloud.y[i] - center.y();
    keep[i] = dx * dx + dy * dy <= radius_m * radius_m ? 0 : 1;
  }
  return keep;
}

}  // namespace

KeptPoints ArtificialBlindSpots(const PointCloud& source, const PointCloud& target,
                                double radius_m) {
  return {KeepOutside(source, source.sensor, radius_m),
          KeepOutside(target, target.sensor, radius_m)};
}

KeptPoints EgoBlindSpotFilter(const PointCloud& source, const PointCloud& target,
                              const SE3d& T_target_source_estimate, double radius_m) {
  return {KeepOutside(source, T_target_source_estimate.Inverse() * target.sensor, radius_m),
          KeepOutside(target, T_target_source_estimate * source.sensor, radius_m)};
}

}  // namespace icpscape
