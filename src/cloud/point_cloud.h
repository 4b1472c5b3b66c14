// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_POINT_CLOUD_H_
#define ICPSCAPE_SRC_CLOUD_POINT_CLOUD_H_

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "residuals/lie.h"
#include "src/neighbors/points_view.h"

namespace icpscape {

/// One lidar scan in its sensor's frame: x forward, y left, z up, sensor at the origin; metres.
///
/// A structure of arrays of float. Each optional array is either empty or as long as x; readers
/// and filters keep them in step. All coordinates are finite (the readers drop the rest).
struct PointCloud {
  std::vector<float> x, y, z;
  std::vector<float> intensity;     ///< Optional, sensor units.
  std::vector<float> nx, ny, nz;    ///< Optional unit normals; (0, 0, 0) where there is none.
  std::vector<std::int32_t> ring;   ///< Optional, scan line of the sensor, 0 the uppermost.
  std::vector<std::int32_t> label;  ///< Optional, what was hit (simulated scans know it).

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  bool has_normals() const { return nx.size() == x.size(); }

  Vec3 Point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Vec3 Normal(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }
  bool NormalIsValid(std::size_t i) const {
    return (nx[i] != 0 || ny[i] != 0 || nz[i] != 0) && std::isfinite(nx[i] + ny[i] + nz[i]);
  }
  PointsView View() const { return {x.data(), y.data(), z.data(), x.size()}; }

  /// Keeps the points i with keep[i] != 0, in order, in every array. keep has size() entries.
  PointCloud Select(const std::vector<char>& keep) const;

  /// The cloud seen from another frame: points moved, normals turned.
  PointCloud Transformed(const SE3d& T_other_this) const;
};

/// What a reader left out, and why.
struct DroppedPoints {
  std::size_t non_finite = 0;  ///< A coordinate was NaN, infinite or beyond 1000 km.
  std::size_t zero = 0;        ///< (0, 0, 0), which many sensors write for "no return".
};

/// Drops the points that no registration can use. Normals and intensity follow.
DroppedPoints DropInvalidPoints(PointCloud* cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_POINT_CLOUD_H_
