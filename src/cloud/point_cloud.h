// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_POINT_CLOUD_H_
#define ICPSCAPE_SRC_CLOUD_POINT_CLOUD_H_

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "icpscape/neighbors/points_view.h"
#include "icpscape/residuals/kinds.h"
#include "icpscape/residuals/lie.h"

namespace icpscape {

/// One lidar scan: x forward, y left, z up; metres.
///
/// A structure of arrays of float. Each optional array is either empty or as long as x; readers
/// and filters keep them in step. All coordinates are finite (the readers drop the rest).
struct PointCloud {
  std::vector<float> x, y, z;
  std::vector<float> intensity;     ///< Optional, sensor units.
  std::vector<float> nx, ny, nz;    ///< Optional unit normals; (0, 0, 0) where there is none.
  std::vector<std::int32_t> ring;   ///< Optional, scan line of the sensor, 0 the uppermost.
  std::vector<std::int32_t> label;  ///< Optional, what was hit (simulated scans know it).
  std::vector<float> time_s;        ///< Optional, when it was measured: seconds, from any start.

  Vec3 sensor = Vec3::Zero();  ///< Where the sensor was, in the frame of x, y, z.
  /// What was taken out of the coordinates before they became float: origin + (x, y, z) are those
  /// of the user (m). Whole metres; 0 unless the cloud lies far from the user's origin.
  Vec3 origin = Vec3::Zero();

  std::size_t size() const { return x.size(); }
  bool empty() const { return x.empty(); }
  bool has_normals() const { return Carries(kind::Direction()); }

  Vec3 Point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Vec3 Normal(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }
  bool NormalIsValid(std::size_t i) const { return IsValid(kind::Direction(), i); }
  PointsView View() const { return {x.data(), y.data(), z.data(), x.size()}; }

  /// Keeps the points i with keep[i] != 0, in order, in every array. keep has size() entries.
  PointCloud Select(const std::vector<char>& keep) const;

  /// The cloud seen from another frame: points moved, normals turned.
  PointCloud Transformed(const SE3d& T_other_this) const;

  // What metrics can take of a point, by its kind: the numbers of each kind are arrays.

  using Array = std::vector<float> PointCloud::*;
  static constexpr std::array<Array, 3> ArraysOf(kind::Point) {
    return {&PointCloud::x, &PointCloud::y, &PointCloud::z};
  }
  static constexpr std::array<Array, 3> ArraysOf(kind::Direction) {
    return {&PointCloud::nx, &PointCloud::ny, &PointCloud::nz};
  }
  template <class F>
  static void ForEachKind(F&& f) {
    f(kind::Point());
    f(kind::Direction());
  }

  template <class Kind>
  bool Carries(Kind kind) const {
    return (this->*ArraysOf(kind)[0]).size() == size();
  }
  template <class Kind>
  typename Kind::template Value<float> Get(Kind kind, std::size_t i) const {
    return Kind::template Make<float>([&](std::size_t k) { return (this->*ArraysOf(kind)[k])[i]; });
  }
  /// Whether the point has it: it is finite, and not 0.
  template <class Kind>
  bool IsValid(Kind kind, std::size_t i) const {
    const auto value = Get(kind, i);
    return !Kind::template Mark<float>(value).isZero(0) && value.allFinite();
  }
};

/// What a reader left out, and why.
struct DroppedPoints {
  std::size_t non_finite = 0;  ///< A coordinate was NaN, infinite, or 1000 km out.
  std::size_t zero = 0;        ///< (0, 0, 0), which many sensors write for "no return".
};

/// Drops the points that no registration can use. Normals and intensity follow.
DroppedPoints DropInvalidPoints(PointCloud* cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_POINT_CLOUD_H_
