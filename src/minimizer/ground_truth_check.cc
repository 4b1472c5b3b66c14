// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/ground_truth_check.h"

#include "icpscape/cloud/displacement.h"
#include "icpscape/common/error.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/objective/source_centroid.h"

namespace icpscape {

GroundTruthCheck CheckGroundTruth(const SearchableCloud& source, const SearchableCloud& target,
                                  const SE3d& T_ground_truth, int threads) {
  const ClosestPointMatcher matcher(source, target, {kGroundTruthCheckGateM});
  const Objective objective("point_to_plane", matcher);
  MinimizerOptions options;
  options.threads = threads;
  GroundTruthCheck check;
  check.summary = Minimize(objective, T_ground_truth, options);
  if (!check.summary.Usable()) {
    throw ComputationError("ground-truth check: " + check.summary.message);
  }
  check.T_refined = check.summary.T_target_source();
  const Displacement difference =
      DisplacementAt(SourceCentroid(objective), T_ground_truth.Inverse() * check.T_refined);
  check.translation_m = difference.m;
  check.rotation_rad = difference.rad;
  return check;
}

}  // namespace icpscape
