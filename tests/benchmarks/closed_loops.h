// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_CLOSED_LOOPS_H_
#define ICPSCAPE_TESTS_BENCHMARKS_CLOSED_LOOPS_H_

#include <cmath>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

// Point-to-plane registration from the identity, written in several ways. All stop at a step below
// both limits, build what trees they need, and take the target's normals as given.

inline constexpr double kLoopGateM = 1;
inline constexpr double kLoopMinStepM = 1e-3;
inline constexpr double kLoopMinStepRad = 0.1 * M_PI / 180;
inline constexpr int kLoopMaxIterations = 50;

struct LoopResult {
  SE3d T_target_source;
  double cost = 0;          ///< 1/2 sum r^2 at that pose, with its matches; 0 where not computed.
  int matching_passes = 0;  ///< 0 where not counted.
};

/// This library's Minimize, through Ceres.
LoopResult RegisterOurs(const PointCloud& source, const PointCloud& target, int threads);

/// Gauss-Newton by hand in double on this library's matcher. Like Minimize it stops before the step
/// that is too short, so that its result has been matched and summed.
LoopResult RegisterByHand(const PointCloud& source, const PointCloud& target, int threads);

/// The loop of A-LOAM's odometry, which many have taken over: for every association a new
/// ceres::Problem of one automatically differentiated residual per pair, and up to four steps on
/// it. One thread; closest points by nanoflann.
LoopResult RegisterALoamStyle(const PointCloud& source, const PointCloud& target);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_CLOSED_LOOPS_H_
