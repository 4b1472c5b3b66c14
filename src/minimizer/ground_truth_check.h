// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MINIMIZER_GROUND_TRUTH_CHECK_H_
#define ICPSCAPE_SRC_MINIMIZER_GROUND_TRUTH_CHECK_H_

#include "icpscape/minimizer/minimizer.h"

namespace icpscape {

/// How far the closed loop moves when it is started at the ground truth. KITTI's poses are smooth
/// over a drive but can be decimetres off from one scan to the next: an argmin that is off by as
/// much is the pose's error, not the metric's.
struct GroundTruthCheck {
  SE3d T_refined;            ///< Where point-to-plane ends.
  double translation_m = 0;  ///< Distance of the source's centroid between the two poses.
  double rotation_rad = 0;
  MinimizerSummary summary;
};

/// Pairs further apart than this do not take part: what one scan sees and the other does not must
/// not decide about the truth.
inline constexpr double kGroundTruthCheckGateM = 1.0;

/// Refines the pose by point-to-plane with pairs up to kGroundTruthCheckGateM. The target needs
/// normals. Throws ComputationError where that has no answer.
GroundTruthCheck CheckGroundTruth(const SearchableCloud& source, const SearchableCloud& target,
                                  const SE3d& T_ground_truth, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MINIMIZER_GROUND_TRUTH_CHECK_H_
