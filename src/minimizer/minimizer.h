// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MINIMIZER_MINIMIZER_H_
#define ICPSCAPE_SRC_MINIMIZER_MINIMIZER_H_

#include <functional>
#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/objective/joint_objective.h"
#include "icpscape/residuals/dof_mask.h"

namespace icpscape {

/// When the matches follow the pose. (Not after the accepted steps of one Solve: Ceres would then
/// compare the costs of two different objectives.)
enum class Reassociation {
  /// One Solve whose every evaluated pose is matched anew, with non-monotone steps: what is
  /// minimised is the re-associated objective itself. Not for matchers that reject: where n changes
  /// from pose to pose, sums over n pairs cannot be compared (it ends with kNoDescent).
  kEveryEvaluation,
  /// One Ceres step on frozen matches, then match again: ICP as it is written in textbooks.
  kEveryStep,
};

/// Rotations are measured in metres at this distance L from the source's centroid c where the
/// eigenvalues of a Hessian are compared with one another: xi' = M xi = [L omega; v + omega x c],
/// H' = M^-T H M^-1.
inline constexpr double kRotationLength_m = 10;

/// One accepted pose. All values are the objective's at this pose, with the matches of this pose.
struct Iterate {
  SE3d T_target_source;
  double cost = 0;
  double rmse = 0;
  long n = 0;
  double gradient_norm = 0;
  /// Of the Gauss-Newton Hessian over the free directions, about the source's centroid and with
  /// rotations in units of 1 / kRotationLength_m (m^2 per m^2). A smallest one near 0 means a
  /// direction that the pairs do not determine.
  double smallest_eigenvalue = 0, largest_eigenvalue = 0;
  double step_m = 0;    ///< Way of the source's centroid since the iterate before.
  double step_rad = 0;  ///< Angle of the rotation since the iterate before.
  double time_s = 0;    ///< Since the start of Minimize.
};

/// What an observer sees of an iterate; valid during the call.
struct Observation {
  const Iterate& iterate;
  const Evaluation& evaluation;     ///< Value, gradient, Hessian and eps there.
  const MatchesByMatcher& matches;  ///< The pairs that they are sums over.
};

/// Called once for every iterate, the start included; false ends the loop.
using Observer = std::function<bool(const Observation&)>;

struct MinimizerOptions {
  Reassociation reassociation = Reassociation::kEveryStep;
  int max_iterations = 50;
  /// Converged where the next step would move the source's centroid and turn by less than this. A
  /// tenth of a millimetre is far below what re-association leaves of the objective's smoothness.
  double min_step_m = 1e-4;
  double min_step_rad = 1e-5;
  /// Ends where the cost changed by less than this share of it from one iterate to the next; 0:
  /// never. The matches change between the two.
  double min_cost_change = 0;
  /// Ends where the cost is this or less [the paper's "falls below threshold", sec. 2].
  double max_final_cost = 0;
  /// Directions in which the source may move; at least one.
  DofMask free = kAllDof;
  Observer observer = nullptr;
  int threads = 1;
};

enum class Termination {
  kConverged,          ///< The next step would be short enough.
  kCostChange,         ///< The cost hardly changed.
  kCostReached,        ///< The cost is as low as was asked for.
  kNoDescent,          ///< No step along the model lowered the cost, or only a vanishing one.
  kLimitCycle,         ///< The same poses came again and again; the result is their best.
  kMaxIterations,      ///< The limit on iterations was reached.
  kStopped,            ///< The observer ended it.
  kNoCorrespondences,  ///< A pose had no usable pair.
  kFailure,            ///< The solver gave up; the message says why.
};
template <>
struct Names<Termination> {
  static constexpr const char* kWhat = "termination";
  static constexpr const char* kNames[] = {"converged",  "cost_change",        "cost_reached",
                                           "no_descent", "limit_cycle",        "max_iterations",
                                           "stopped",    "no_correspondences", "failure"};
};

/// Whether the pose where it ended is a result.
inline bool IsUsable(Termination termination) {
  return termination != Termination::kNoCorrespondences && termination != Termination::kFailure;
}

struct MinimizerSummary {
  /// The first is the start, the last the result.
  std::vector<Iterate> iterates;
  Termination termination = Termination::kFailure;
  std::string message;  ///< One sentence.
  int matching_passes = 0;
  /// kLimitCycle: how far its poses take the source's centroid from the best of them, at most.
  double cycle_m = 0, cycle_rad = 0;

  bool Usable() const { return IsUsable(termination); }
  /// The result and its cost: the re-associated objective's value at that pose.
  const SE3d& T_target_source() const { return iterates.back().T_target_source; }
  double final_cost() const { return iterates.back().cost; }
};

/// The closed loop [paper fig. 1]: minimises the objective from a start pose with Ceres, through
/// one SquareRootCost (or, for a loss with rho'' > 0, one residual block per pair; that needs
/// kEveryStep and is said in the log). Never throws for trouble with the data: see termination.
/// Where kEveryStep comes back to a pose that it had a few steps before, and again the step after,
/// pairs change back and forth for ever: it ends with the pose of least RMSE among these.
/// Under kEveryEvaluation the observer also sees what non-monotone steps tried on the way; the
/// summary ends with the pose of least cost.
MinimizerSummary Minimize(const JointObjective& objective, const SE3d& T_start,
                          const MinimizerOptions& options);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MINIMIZER_MINIMIZER_H_
