// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/minimizer/minimizer.h"
#include "tests/benchmarks/closed_loops.h"
#include "tests/benchmarks/comparison.h"

namespace icpscape {

LoopResult RegisterOurs(const PointCloud& source, const PointCloud& target, int threads) {
  MatchingOptions matching;
  matching.max_distance_m = kLoopGateM;
  const ClosestPointMatcher matcher({source, threads}, {target, threads}, matching);
  const Objective objective("point_to_plane", matcher);
  MinimizerOptions options;
  options.max_iterations = kLoopMaxIterations;
  options.min_step_m = kLoopMinStepM;
  options.min_step_rad = kLoopMinStepRad;
  options.threads = threads;
  const MinimizerSummary summary = Minimize(objective, SE3d(), options);
  if (summary.termination != Termination::kConverged) {
    throw Mismatch("icpscape: no convergence: " + summary.message);
  }
  return {summary.T_target_source(), summary.final_cost(), summary.matching_passes};
}

}  // namespace icpscape
