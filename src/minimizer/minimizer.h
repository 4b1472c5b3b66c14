// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MINIMIZER_MINIMIZER_H_
#define ICPSCAPE_SRC_MINIMIZER_MINIMIZER_H_

#include <string>
#include <vector>

#include "src/objective/joint_objective.h"

namespace icpscape {

/// When the matches follow the pose. Never only after accepted steps of one Solve: Ceres would then
/// compare the costs of two different objectives.
enum class Reassociation {
  /// One Solve whose every evaluated pose is matched anew, with non-monotone steps: what is
  /// minimised is the re-associated objective itself. Not for matchers that reject: where n changes
  /// from pose to pose, sums over n pairs cannot be compared (kNoDescent is how that ends).
  kEveryEvaluation,
  /// One Ceres step on frozen matches, then match again: ICP as it is written in textbooks.
  kEveryStep,
};

struct MinimizerOptions {
  Reassociation reassociation = Reassociation::kEveryStep;
  int max_iterations = 50;
  /// Converged where the next step would be shorter than both. A tenth of a millimetre is far below
  /// what re-association leaves of the objective's smoothness.
  double min_step_m = 1e-4;
  double min_step_rad = 1e-5;
  int threads = 1;
};

/// One accepted pose. All values are the objective's at this pose, with the matches of this pose.
struct Iterate {
  SE3d T_target_source;
  double cost = 0;
  double rmse = 0;
  long n = 0;
  double gradient_norm = 0;
  double step_m = 0;    ///< Length of the translation since the iterate before.
  double step_rad = 0;  ///< Angle of the rotation since the iterate before.
  double time_s = 0;    ///< Since the start of Minimize.
};

enum class Termination {
  kConverged,          ///< The next step would be short enough.
  kNoDescent,          ///< No step along the model lowered the cost, or only a vanishing one.
  kMaxIterations,      ///< The limit on iterations was reached.
  kNoCorrespondences,  ///< A pose had no usable pair.
  kFailure,            ///< The solver gave up; the message says why.
};
const char* TerminationName(Termination termination);

struct MinimizerSummary {
  /// The first is the start, the last the result.
  std::vector<Iterate> iterates;
  Termination termination = Termination::kFailure;
  std::string message;  ///< One sentence.
  int matching_passes = 0;

  bool Usable() const {
    return termination == Termination::kConverged || termination == Termination::kNoDescent ||
           termination == Termination::kMaxIterations;
  }
  /// The result and its cost: the re-associated objective's value at that pose.
  const SE3d& T_target_source() const { return iterates.back().T_target_source; }
  double final_cost() const { return iterates.back().cost; }
};

/// The closed loop [paper fig. 1]: minimises the objective from a start pose with Ceres, through
/// one SquareRootCost (or, for a loss with rho'' > 0, one residual block per pair; that needs
/// kEveryStep and is said in the log). Never throws for trouble with the data: see termination.
MinimizerSummary Minimize(const JointObjective& objective, const SE3d& T_start,
                          const MinimizerOptions& options);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MINIMIZER_MINIMIZER_H_
