// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/filter_bias.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"
#include "icpscape/common/text.h"
#include "icpscape/landscape/path.h"
#include "icpscape/neighbors/neighbor_search.h"

namespace icpscape {
namespace {

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

ErrorAxis AlongPath(const SE3d& T_target_source, const Vec3& sensor, double range_m) {
  const double length_m = (T_target_source * sensor - sensor).norm();
  if (length_m < 1e-3) {
    throw UsageError("motion of " + Number(length_m) +
                     " m: expected at least 1 mm to sweep along it.");
  }
  const Path path(SE3d(), T_target_source, PathKind::kLerpSlerp, sensor);
  return {"along_path", "m", range_m,
          [path, length_m](double e) { return path.Pose(1 + e / length_m); }};
}

ErrorAxis Yaw(const SE3d& T_target_source, const Vec3& sensor, double range_deg) {
  const SE3d T_source_sensor(Mat3::Identity(), sensor);
  return {"yaw", "deg", range_deg, [T_target_source, T_source_sensor](double e) {
            return T_target_source * T_source_sensor *
                   SE3d::Exp((Vec6() << 0, 0, e * M_PI / 180, 0, 0, 0).finished()) *
                   T_source_sensor.Inverse();
          }};
}

double ArgminError(const Objective& objective, const ErrorAxis& axis, int samples, int threads) {
  if (samples < 3) {
    throw UsageError("samples " + std::to_string(samples) + ": expected at least 3.");
  }
  const double step = 4 * axis.range / (samples - 1);
  const auto error = [&](std::size_t i) { return -2 * axis.range + step * static_cast<double>(i); };
  std::vector<double> rmse(static_cast<std::size_t>(samples));
  ParallelFor(rmse.size(), threads,
              [&](std::size_t i) { rmse[i] = objective.Evaluate(axis.pose(error(i)), 1).Rmse(); });
  if (std::any_of(rmse.begin(), rmse.end(), [](double value) { return std::isnan(value); })) {
    throw ComputationError("no correspondence is left for " + objective.metric().name +
                           " at some of the poses.");
  }
  const auto least =
      static_cast<std::size_t>(std::min_element(rmse.begin(), rmse.end()) - rmse.begin());
  if (least == 0 || least + 1 == rmse.size()) {
    return error(least);
  }
  const double curvature = rmse[least - 1] - 2 * rmse[least] + rmse[least + 1];
  const double vertex = curvature > 0 ? 0.5 * (rmse[least - 1] - rmse[least + 1]) / curvature : 0.0;
  return error(least) + vertex * step;
}

double RegressionSlope(const std::vector<double>& x, const std::vector<double>& y) {
  const double mean_x = Mean(x);
  const double mean_y = Mean(y);
  double xx = 0;
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return xy / xx;
}

DynamicRemains FindDynamicRemains(const PointCloud& source, const PointCloud& target,
                                  const std::vector<char>& keep_source, const SE3d& T_target_source,
                                  double reach_m,
                                  const std::function<bool(std::int32_t label)>& is_dynamic) {
  if (source.label.size() != source.size() || target.label.size() != target.size()) {
    throw InputError("the scans have no labels; expected what each point hit.");
  }
  std::vector<char> dynamic_target(target.size());
  for (std::size_t i = 0; i < target.size(); ++i) {
    dynamic_target[i] = is_dynamic(target.label[i]) ? 1 : 0;
  }
  const PointCloud objects = target.Select(dynamic_target);
  DynamicRemains remains;
  const NeighborSearch search(objects.View());
  std::vector<Neighbor> neighbors;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (!is_dynamic(source.label[i])) {
      continue;
    }
    const Eigen::Vector3f p = (T_target_source * source.Point(i)).cast<float>();
    search.WithinRadius(p, static_cast<float>(reach_m), &neighbors);
    const bool overlaps =
        std::any_of(neighbors.begin(), neighbors.end(), [&](const Neighbor& neighbor) {
          return objects.label[static_cast<std::size_t>(neighbor.index)] == source.label[i];
        });
    ++remains.dynamic;
    remains.overlapping += overlaps ? 1 : 0;
    remains.kept += keep_source[i] != 0 ? 1 : 0;
    remains.kept_overlapping += overlaps && keep_source[i] != 0 ? 1 : 0;
  }
  return remains;
}

}  // namespace icpscape
