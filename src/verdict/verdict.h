// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_VERDICT_VERDICT_H_
#define ICPSCAPE_SRC_VERDICT_VERDICT_H_

#include <cmath>
#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/minimizer/minimizer.h"
#include "icpscape/verdict/named_directions.h"

namespace icpscape {

/// Why the data do not determine a pose in a direction. The first two are of the objective: no
/// tolerance helps. See docs/verdict.md for where the limits come from.
enum class Cause {
  kNotObserved,      ///< An eigenvalue of H is below 1e-12 of the largest: no pair sees it.
  kNoCurvature,      ///< Matched anew at every pose, the cost has no minimum along it.
  kBeyondTolerance,  ///< Its predicted deviation is beyond the tolerance.
};
template <>
struct Names<Cause> {
  static constexpr const char* kWhat = "cause";
  static constexpr const char* kNames[] = {"not_observed", "no_curvature", "beyond_tolerance"};
};

/// A direction in which the data do not determine the pose: [L omega; v] about the centroid of the
/// source's points, L their root mean square distance from it.
struct UndeterminedDirection : NamedDirection {
  Cause cause;
};

struct VerdictOptions {
  double tolerance_m = 0.05;
  double tolerance_rad = 0.3 * M_PI / 180;
  /// Edge of the cubes of the target frame whose residuals may be correlated.
  double cluster_m = 1;
  /// Of the loop that is judged: its free directions, its stop rule, its threads.
  MinimizerOptions minimizer;
};

/// What a registration's answer is worth, told from the data alone.
struct Verdict {
  Termination termination = Termination::kFailure;
  /// The loop ended by its own stop rule, by one that was asked for, or in a limit cycle whose
  /// poses differ by less than a tenth of the tolerances.
  bool converged = false;
  long pairs = 0;            ///< At the pose.
  long rows = 0;             ///< Residual rows of these pairs.
  double matched_share = 0;  ///< Share of the source's points that took part.
  std::vector<UndeterminedDirection> undetermined;
  /// Predicted standard deviations of xi = [omega; v] (rad, m) about the centroid of the source's
  /// points, T_true = T Exp(xi): those of sandwich_rematched. NaN along axes that are undetermined,
  /// 0 along those that were not free.
  Vec6 deviation = Vec6::Zero();
  /// [L omega; v] about the centroid, from xi.
  Mat6 to_centroid = Mat6::Identity();
  /// Why there is no pose: fewer rows than free directions, no pairs, failure. Else empty.
  std::string no_pose;

  bool HasPose() const { return no_pose.empty(); }
  bool Determined() const { return HasPose() && undetermined.empty(); }
  /// Orthonormal columns in the coordinates of `direction`: what the objective does not see,
  /// whatever the tolerance.
  Eigen::Matrix<double, 6, Eigen::Dynamic> Unobservable() const;
  /// The pose with the predicted one in the directions that are Unobservable.
  SE3d WithPrediction(const SE3d& T_found, const SE3d& T_predicted) const;
  /// What the undetermined directions span together, in words: "along x", "yaw".
  std::vector<std::string> UndeterminedNames() const;
  /// "determined, converged, 97 % of the points took part"; in one line, without a stop.
  std::string Text() const;
};

/// Judges where Minimize ended. With H and B (the derivative of the gradient where every pose has
/// its own pairs, see CovarianceSums) about the centroid and over the free directions: directions
/// that H does not see are taken out, then those along which B's symmetric part has no positive
/// eigenvalue (above 1e-6 of H's largest: below that, rounding decides); in the rest the predicted
/// covariance is c B^-1 (sum G_c G_c^T) B^-T, c correcting for few rows and few cubes. Its blocks
/// of rotation and translation are compared with the tolerances, each along its own main axes.
/// Costs up to 13 matching passes.
Verdict JudgePose(const JointObjective& objective, const MinimizerSummary& summary,
                  const VerdictOptions& options);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_VERDICT_VERDICT_H_
