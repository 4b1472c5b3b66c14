// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PAPER_FILTER_BIAS_H_
#define ICPSCAPE_SRC_PAPER_FILTER_BIAS_H_

#include <functional>
#include <string>
#include <vector>

#include "icpscape/objective/objective.h"

namespace icpscape {

/// Poses about the true motion along one axis: pose(e) is off by e.
struct ErrorAxis {
  std::string name;  ///< "along_path" or "yaw".
  std::string unit;  ///< "m" or "deg".
  double range = 0;  ///< The estimates' errors run over [-range, range].
  /// T_target_source whose error is e; e = 0 is the truth.
  std::function<SE3d(double e)> pose;
};

/// e metres further along the straight line of the lidar's motion and its rotation: T(u) of the
/// paper's path with u = 1 + e / |t|. The lidar is at `sensor` in the source's frame. Throws
/// UsageError where the motion is shorter than 1 mm.
ErrorAxis AlongPath(const SE3d& T_target_source, const Vec3& sensor, double range_m);

/// Turned by e degrees about the lidar's vertical: T Exp([0 0 e; 0]) with the lidar at the origin.
ErrorAxis Yaw(const SE3d& T_target_source, const Vec3& sensor, double range_deg);

/// The error at which the objective is least, between -2 range and 2 range: least of `samples`
/// poses, then the vertex of the parabola of rmse through it and its two neighbours.
double ArgminError(const Objective& objective, const ErrorAxis& axis, int samples, int threads);

/// Slope of the least-squares line through the points (x_i, y_i).
double RegressionSlope(const std::vector<double>& x, const std::vector<double>& y);

/// The dynamic points of the source that a filter kept, and where they are.
struct DynamicRemains {
  std::size_t dynamic = 0;
  std::size_t overlapping = 0;  ///< Of all dynamic: see `reach_m`.
  std::size_t kept = 0;
  std::size_t kept_overlapping = 0;  ///< Of the kept.
};

/// A dynamic point overlaps where a point of the same object in the target is within reach_m of it
/// under T: there the object's two poses cover the same place, and a filter by occupied voxels must
/// keep it. Points of one object have the same whole label. Throws InputError without labels.
DynamicRemains FindDynamicRemains(const PointCloud& source, const PointCloud& target,
                                  const std::vector<char>& keep_source, const SE3d& T_target_source,
                                  double reach_m,
                                  const std::function<bool(std::int32_t label)>& is_dynamic);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PAPER_FILTER_BIAS_H_
