// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COVARIANCE_DEGENERACY_H_
#define ICPSCAPE_SRC_COVARIANCE_DEGENERACY_H_

#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/objective/objective.h"

namespace icpscape {

/// A Hessian over [omega; v], seen in [L omega; v + omega x c]: M^-T H M^-1 with the M of
/// AboutPoint.
Mat6 HessianAbout(const Vec3& c, double lever_m, const Mat6& hessian);

/// Eigenvalues of a Hessian, ascending, and their unit eigenvectors (columns), in the tangent
/// vectors [L omega; v + omega x c]: with rotations measured as lengths at a lever arm L from c,
/// all eigenvalues have one unit (that of d^2 cost / dm^2; without it they are squares of lengths
/// beside numbers, and which of them is smallest depends on the unit of length).
struct EigenDirections {
  double length_scale_m = 0;
  Vec6 eigenvalues = Vec6::Zero();
  Mat6 directions = Mat6::Identity();
};
/// Throws UsageError unless length_scale_m is positive.
EigenDirections EigenDirectionsOf(const Mat6& hessian, const Vec3& c, double length_scale_m);

/// How well a direction is determined, in the words of X-ICP.
enum class Localizability { kFull, kPartial, kNone };
template <>
struct Names<Localizability> {
  static constexpr const char* kWhat = "localizability";
  static constexpr const char* kNames[] = {"full", "partial", "none"};
};

/// What one published rule says about one direction.
struct Judgement {
  std::string rule;               ///< "loam_odometry", "loam_mapping", "x_icp" or "dcreg".
  std::string source;             ///< Where it comes from.
  Vec6 direction;                 ///< Unit vector in [omega; v] (rad, m), source frame.
  double value;                   ///< What the rule looks at ...
  double threshold;               ///< ... and the threshold that decides about degeneracy.
  Localizability localizability;  ///< kNone is "degenerate".
};

/// One row of a point-to-plane problem: normal n (unit) and p x n, as X-ICP takes it.
struct PlaneConstraint {
  Vec3 p_source;
  Vec3 n_source;  ///< The target's normal, seen from the source frame.
};
/// The pairs of an objective that matches points with planes; empty for other objectives.
std::vector<PlaneConstraint> PlaneConstraintsOf(const Objective& objective,
                                                const SE3d& T_target_source,
                                                const Matches& matches);

// The judgements of one rule: six, over the directions that the rule itself looks at. The rules are
// published for clouds with the sensor at the origin, and what they say depends on that point: they
// take the Hessian about the sensor, and v is the sensor's velocity.

/// Zhang, Kaess & Singh 2016: an eigenvalue of H = J^T J below a threshold; H as it comes, in rad
/// and m. The paper leaves the threshold to experiments. Those in use are constants on sums over
/// all pairs, so that the number of points decides with them.
std::vector<Judgement> JudgeEigenvalues(const std::string& rule, const std::string& source,
                                        const Mat6& hessian, double threshold);
/// Scan to scan: loam_velodyne and LeGO-LOAM.
constexpr double kLoamOdometryThreshold = 10;
/// Scan to map: loam_velodyne and LIO-SAM.
constexpr double kLoamMappingThreshold = 100;

/// X-ICP [Tuna et al. 2024, sec. V]: eigenvectors v_j of the 3x3 blocks of H. Each pair contributes
/// |f_i . v_j|, f_i being n_i (translation) or the unit vector of (p_i - c) x n_i (rotation; c is
/// the centroid of the p_i). Contributions below cos(80 deg) are noise; L_c sums the others, L_s
/// those of at least cos(45 deg).
///   full:    L_c >= 250 or L_s >= 180
///   partial: L_c >= 180 or L_s >= 35
/// `value` is L_c, `threshold` 180.
/// Thresholds as a published summary of the paper gives them; the authors' code has others in its
/// parameter files (300, 300, 150). That code takes c from all matched points, as is done here.
std::vector<Judgement> JudgeXicp(const Mat6& hessian, const std::vector<PlaneConstraint>& pairs);

/// DCReg [Hu et al. 2025, eq. 18 to 21]: eigenvalues lambda_j of the Schur complements
///   S_R = H_RR - H_Rt H_tt^-1 H_tR,  S_t = H_tt - H_tR H_RR^-1 H_Rt
/// each within its own three: degenerate where lambda_max / lambda_j > 10 (`value`, and the
/// default of the authors' code). Where a block is singular its pseudo-inverse stands for the
/// inverse; the authors' code calls all six directions degenerate there.
std::vector<Judgement> JudgeDcreg(const Mat6& hessian);

/// All rules side by side; X-ICP's where there are pairs for it. The Hessian is about the sensor.
std::vector<Judgement> JudgeDegeneracy(const Mat6& hessian,
                                       const std::vector<PlaneConstraint>& pairs);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COVARIANCE_DEGENERACY_H_
