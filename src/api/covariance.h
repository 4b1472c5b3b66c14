// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_API_COVARIANCE_H_
#define ICPSCAPE_SRC_API_COVARIANCE_H_

#include <optional>
#include <string>
#include <vector>

#include "icpscape/api/pair.h"
#include "icpscape/covariance/registration_uncertainty.h"
#include "icpscape/verdict/verdict.h"

namespace icpscape {

/// Options of Covariance.
struct PairCovarianceOptions : PairOptions {
  /// By default point_to_point, point_to_plane and symmetric.
  PairCovarianceOptions();

  /// What the estimators assume about the noise.
  CovarianceOptions estimators;
  /// Lever arm from the source's centroid at which rotations count as lengths (m), in `directions`.
  double length_scale_m = 10;
  /// Tolerances of the verdict. Its `minimizer` is not used.
  VerdictOptions verdict;
};

/// How sure the registration by one metric is.
struct CovarianceResult {
  std::string metric;
  SE3d T_target_source;
  Termination termination = Termination::kFailure;
  Verdict verdict;  ///< What the pose is worth.

  /// What each estimator says, in the order of AllOf<Estimator>.
  std::vector<EstimatedCovariance> covariances;
  /// The 6x6 covariance of xi in T_true = T_target_source Exp(xi), xi = [omega; v]: rotation about
  /// x, y, z (rad), then translation along x, y, z (m), in the frame of the source, less its origin
  /// where it lies far out (see PointCloud::origin): rotation is about that point. Nothing where
  /// the pairs do not determine all six directions, or the estimator lacks what it needs:
  /// EstimatedCovariance::reason says which.
  const std::optional<Mat6>& Of(Estimator estimator) const;

  /// Of the Gauss-Newton Hessian about the source's centroid, the weakest first.
  EigenDirections directions;
  std::vector<Judgement> degeneracy;  ///< The published rules, side by side; see degeneracy.h.
  std::string warning;  ///< Where the estimators are known to be wrong for the metric; else empty.
};

/// Registers two clouds by each metric, to 10 micrometres, and says how sure each result is: the
/// covariances of six estimators (formulas at Estimator), and the directions that the pairs
/// determine badly.
///
/// Clouds are in metres, each in its own frame; see Register.
///
/// icpscape-covariance with the same options has the same bits in its tables.
///
/// Throws what Register throws for options and clouds, and ComputationError where a registration
/// has no usable result.
std::vector<CovarianceResult> Covariance(PointCloud source, PointCloud target,
                                         const PairCovarianceOptions& options = {});

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_API_COVARIANCE_H_
