// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_INVARIANCE_PAIRS_H_
#define ICPSCAPE_TESTS_INVARIANCE_PAIRS_H_

#include <cmath>
#include <string>
#include <vector>

#include "icpscape/api/landscape.h"
#include "icpscape/api/register.h"
#include "icpscape/cloud/displacement.h"
#include "icpscape/io/sequences.h"
#include "icpscape/simulation/simulated_sequence.h"
#include "tests/support/real_scans.h"

namespace icpscape::testing_support {

/// A turn of a simulated lidar with a firing every degree, by 0.9 m and 4 degrees.
inline const ScanPair& SimulatedTurn() {
  static const ScanPair pair = [] {
    LidarOptions lidar;
    lidar.azimuth_step_deg = 1;
    return SimulatePair("right_turn", 3, lidar, 2);
  }();
  return pair;
}

inline PointCloud EveryFourth(const PointCloud& cloud) {
  std::vector<char> keep(cloud.size(), 0);
  for (std::size_t i = 0; i < keep.size(); i += 4) {
    keep[i] = 1;
  }
  return cloud.Select(keep);
}

/// KITTI 00/95, another turn, with every fourth point.
inline ScanPair KittiTurn() {
  ScanPair pair = OpenKittiSequence(KittiRoot(), "00").Pair(95, 94);
  pair.source = EveryFourth(pair.source);
  pair.target = EveryFourth(pair.target);
  return pair;
}

/// Steps are so short at the end that rounding is what is left.
inline SE3d Registered(const PointCloud& source, const PointCloud& target,
                       const std::string& metric, const SE3d& T_initial, double metre = 1) {
  RegisterOptions options;
  options.metrics = {metric};
  options.T_initial = T_initial;
  options.objective.matching.max_distance_m = 2 * metre;
  options.minimizer.max_iterations = 200;
  options.minimizer.min_step_m = 1e-6 * metre;
  options.minimizer.min_step_rad = 1e-7;
  options.threads = 2;
  return Register(source, target, options).T_target_source;
}

/// How far the cloud, and by what angle, two poses take it apart: metres, degrees.
inline Displacement Apart(const PointCloud& source, const SE3d& a, const SE3d& b) {
  const Displacement apart = DisplacementAt(CentroidOf(source), a.Inverse() * b);
  return {apart.m, apart.rad * 180 / M_PI};
}

/// The curves of the metrics between two poses.
inline std::vector<Curve> Curves(const PointCloud& source, const PointCloud& target,
                                 const std::vector<std::string>& metrics, const SE3d& T_0,
                                 const SE3d& T_1, PathKind path) {
  LandscapeOptions options;
  options.metrics = metrics;
  options.T_initial = T_0;
  options.path = path;
  options.curve.samples = 13;
  options.threads = 2;
  return Landscape(source, target, T_1, options).curves;
}

/// Fails where rmse differs by more than this share of the curve's highest, or its slope by half a
/// percent of the steepest: both jump a little where a pair changes. `unit` is that of the others.
inline void ExpectEqualCurves(const std::vector<Curve>& curves, const std::vector<Curve>& others,
                              double share, double unit = 1) {
  ASSERT_EQ(curves.size(), others.size());
  for (std::size_t m = 0; m < curves.size(); ++m) {
    ASSERT_EQ(curves[m].points.size(), others[m].points.size());
    double highest = 0, steepest = 0;
    for (const CurvePoint& point : curves[m].points) {
      highest = std::max(highest, point.rmse);
      steepest = std::max(steepest, std::abs(point.slope_analytic));
    }
    for (std::size_t i = 0; i < curves[m].points.size(); ++i) {
      const CurvePoint& point = curves[m].points[i];
      const CurvePoint& other = others[m].points[i];
      EXPECT_NEAR(other.rmse / unit, point.rmse, share * highest) << curves[m].metric << i;
      EXPECT_NEAR(other.slope_analytic / unit, point.slope_analytic, 5e-3 * steepest)
          << curves[m].metric << i;
    }
  }
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_INVARIANCE_PAIRS_H_
