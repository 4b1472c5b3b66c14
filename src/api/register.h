// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_API_REGISTER_H_
#define ICPSCAPE_SRC_API_REGISTER_H_

#include <string>
#include <vector>

#include "icpscape/api/pair.h"
#include "icpscape/minimizer/registration.h"
#include "icpscape/verdict/verdict.h"

namespace icpscape {

/// Options of Register.
struct RegisterOptions : PairOptions {
  /// By default point_to_plane; steps below 0.1 mm and 0.001 degrees end the search.
  RegisterOptions();
  /// Preset::kRobust with the normals that go with it: for clouds that overlap in part, and starts
  /// that are far off.
  static RegisterOptions Robust();

  /// With kRobust leave the gate, the loss and the re-association as they are.
  Preset preset = Preset::kPaper;
  /// Several metrics are minimised together: cost = sum_k w_k cost_k. One positive weight for each
  /// metric, or none: then each is 1.
  std::vector<double> weights;
  /// When to stop, which directions are free, and the observer. Its `threads` is not used.
  MinimizerOptions minimizer;
  /// Tolerances of the verdict. Its `minimizer` is not used.
  VerdictOptions verdict;
};

/// The result of Register.
struct RegisterResult {
  /// p_target = T_target_source * p_source. The start pose where the result is not usable.
  SE3d T_target_source;
  Termination termination = Termination::kFailure;
  std::string message;  ///< Why it ended, in one sentence.

  /// What the pose is worth: determined or not, converged or not.
  Verdict verdict;

  /// Whether the pose is a result. A limit on iterations leaves a pose that may be far from the
  /// minimum: see `termination`.
  bool Usable() const { return IsUsable(termination); }

  /// Each loop of the preset, the last of which judges the pose; one under kPaper.
  std::vector<Stage> stages;
  double cost = 0;     ///< At the pose, over the pairs that belong to it; see Register.
  double rmse = 0;     ///< sqrt(eps / n) there (m), eps as the paper prints it.
  long num_pairs = 0;  ///< Pairs there.
  /// From the start to the result, with the cost, the gradient's length and the time of each.
  std::vector<Iterate> iterates;
};

/// Registers two clouds: finds the rigid motion T that minimises
///   cost(T) = 1/2 sum_i rho(|r_i(T)|^2)
/// over the pairs (p_i, q_i) that belong to T, with r the residual of the metric and rho the loss.
/// Pairs are found anew after each step of Ceres' trust region.
///
/// Clouds are in metres, each in its own frame, with the sensor at PointCloud::sensor (the origin
/// by default). What lies far out is registered less its origin (see PointCloud::origin), and poses
/// are given and returned in the coordinates of the user. The observer, and directions in the
/// verdict, see the clouds less their origins. A metric of planes or normals estimates normals from
/// 20 neighbours; those of edges and planar points need scan lines: PointCloud::ring, or scans
/// whose rings can be recovered.
///
/// icpscape-register with the same options finds the same bits.
///
/// Throws UsageError for options out of range, InputError for clouds that are malformed or have no
/// scan lines where they are needed, ComputationError where no source point is left. A registration
/// that fails does not throw: see RegisterResult::termination.
RegisterResult Register(PointCloud source, PointCloud target, const RegisterOptions& options = {});

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_API_REGISTER_H_
