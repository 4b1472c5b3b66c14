// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COVARIANCE_COVARIANCE_H_
#define ICPSCAPE_SRC_COVARIANCE_COVARIANCE_H_

#include <optional>
#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/objective/joint_objective.h"

namespace icpscape {

struct CovarianceOptions {
  /// Standard deviation of one range, independent from point to point (Censi).
  double range_noise_m = 0.009;
  /// Standard deviation of the constant range errors of the lasers (Censi with ring biases).
  double ring_bias_m = 0.02;
  /// Edge of the cubes of the target frame whose scores are summed (clustered sandwich).
  double cluster_m = 1;
  /// Half the distance over which the rematched Hessian is differenced: a translation by this much,
  /// or a rotation about the sensor that moves points at 10 m by it. Long enough for pairs to
  /// change.
  double rematching_step_m = 0.02;

  /// Throws UsageError naming the value that is out of range.
  void Check() const;
};

/// Sums over the gradients of pairs at one pose; g_i is that of pair i, in T <- T Exp([omega; v]).
struct ScoreSums {
  Mat6 gauss_newton = Mat6::Zero();    ///< H = sum rho' J^T J
  Mat6 scores = Mat6::Zero();          ///< sum_i g_i g_i^T
  Mat6 cluster_scores = Mat6::Zero();  ///< sum_c G_c G_c^T, G_c = sum_{i in c} g_i
  long pairs = 0;
  long rows = 0;      ///< Residual rows of all pairs.
  long clusters = 0;  ///< Cubes of the target frame that hold a pair's target point.
};

/// All terms' pairs, weighted.
ScoreSums SumScores(const JointObjective& objective, const SE3d& T_target_source,
                    const MatchesByMatcher& matches, double cluster_m);

/// Sums over an objective's pairs at one pose, from which every estimator is made.
struct CovarianceSums : ScoreSums {
  Mat6 hessian = Mat6::Zero();  ///< A = d^2 cost / d xi^2, exact for these pairs.
  /// B = d gradient / d xi where every pose has its own pairs; by central differences, not
  /// symmetric.
  Mat6 rematched_hessian = Mat6::Zero();
  /// sum_k b_k b_k^T over all points of both clouds, b_k = d (sum_i g_i) / d range_k (a target
  /// point has many pairs: its derivative is summed before it is squared).
  Mat6 range_noise = Mat6::Zero();
  /// The same over rings, b_k now the derivative by an error that all points of laser k share, in
  /// both clouds. Nothing where a cloud has no rings.
  std::optional<Mat6> ring_bias;
  double cost = 0;
};

/// Sums over the pairs that belong to the pose, found by up to `threads` threads (the result does
/// not depend on it).
CovarianceSums SumForCovariance(const Objective& objective, const SE3d& T_target_source,
                                const CovarianceOptions& options, int threads);
/// The same over given pairs, without the rematched Hessian (left at zero).
CovarianceSums SumForCovariance(const Objective& objective, const SE3d& T_target_source,
                                const Matches& matches, const CovarianceOptions& options);

/// steps^T B steps with the B of CovarianceSums, over motions that are the columns of `steps`, each
/// as long as half the distance over which the gradient is differenced. Two matching passes a
/// column.
Eigen::MatrixXd RematchedHessian(const JointObjective& objective, const SE3d& T_target_source,
                                 const Eigen::Matrix<double, 6, Eigen::Dynamic>& steps,
                                 int threads);

/// The estimators, in the order of the documentation. All are the covariance of xi in
/// T_true = T Exp(xi), that is [omega; v] in the source frame, rad and m.
///   gauss_newton        s^2 H^-1, s^2 = 2 cost / (rows - 6): all residual rows are independent and
///                       equally noisy [linear regression].
///   censi               A^-1 B (sigma^2 I) B^T A^-1, B = d gradient / d ranges of both clouds
///                       [Censi 2007, eq. 4]; only ranges are noisy. Leaves out that normals follow
///                       the points: Censi's csm code differentiates through the line's normal.
///   censi_ring_bias     censi with a second source of noise: the lasers' constant range errors.
///   sandwich            A^-1 (sum g_i g_i^T) A^-1 [Huber 1967; White 1980, HC0]: pairs are
///                       independent, each with a noise of its own.
///   sandwich_clustered  A^-1 (sum G_c G_c^T) A^-1 [Liang & Zeger 1986]: pairs of one cube are
///                       correlated in any way, those of two cubes are not.
///   sandwich_rematched  B^-1 (sum G_c G_c^T) B^-T: the same where the pairs follow the pose. ICP
///                       ends where the gradient g(T, z) over the pairs of T itself is zero; by the
///                       implicit function theorem dT/dz = -B^-1 dg/dz, where B = dg/dT includes
///                       the change of pairs. Bonnabel et al. 2016 show what goes wrong if it does
///                       not.
enum class Estimator {
  kGaussNewton,
  kCensi,
  kCensiRingBias,
  kSandwich,
  kSandwichClustered,
  kSandwichRematched,
};
template <>
struct Names<Estimator> {
  static constexpr const char* kWhat = "estimator";
  static constexpr const char* kNames[] = {"gauss_newton",       "censi",
                                           "censi_ring_bias",    "sandwich",
                                           "sandwich_clustered", "sandwich_rematched"};
};

/// The covariance; nothing where the pairs do not determine all six degrees of freedom: in such a
/// direction the variance is infinite, and a pseudo-inverse would call it 0. A matrix counts as
/// singular where, with rotations scaled to the size of translations, an eigenvalue is below 1e-12
/// of the largest. Also nothing where there is nothing to estimate from: no rings for ring biases,
/// no row to spare for s^2, fewer than six independent clusters.
std::optional<Mat6> EstimateCovariance(Estimator estimator, const CovarianceSums& sums,
                                       const CovarianceOptions& options);

/// One sentence where the metric's closed forms are known to be wrong; empty elsewhere.
std::string CovarianceWarning(const std::string& metric);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COVARIANCE_COVARIANCE_H_
