// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COVARIANCE_REGISTRATION_UNCERTAINTY_H_
#define ICPSCAPE_SRC_COVARIANCE_REGISTRATION_UNCERTAINTY_H_

#include <optional>
#include <string>
#include <vector>

#include "icpscape/covariance/covariance.h"
#include "icpscape/covariance/degeneracy.h"
#include "icpscape/minimizer/minimizer.h"

namespace icpscape {

/// A stop rule of 10 micrometres and 0.06 millidegrees: standard deviations are tenths of
/// millimetres.
MinimizerOptions PreciseMinimizer();

/// What one estimator says about a solution.
struct EstimatedCovariance {
  Estimator estimator = Estimator::kGaussNewton;
  std::optional<Mat6> covariance;
  std::string
      reason;  ///< Why there is no covariance, as half a sentence; empty where there is one.
};

/// How sure a registration is.
struct RegistrationUncertainty {
  MinimizerSummary registration;
  CovarianceSums sums;                           ///< At the solution, as all that follows.
  std::vector<EstimatedCovariance> covariances;  ///< In the order of AllOf<Estimator>.
  EigenDirections directions;         ///< Of the Gauss-Newton Hessian, about the source's centroid.
  std::vector<Judgement> judgements;  ///< Of JudgeDegeneracy.
};

/// Minimises the objective with PreciseMinimizer, and says how sure the solution is. Throws
/// ComputationError where the minimisation has no usable result, UsageError for options out of
/// range.
RegistrationUncertainty RegisterWithUncertainty(const Objective& objective, const SE3d& T_start,
                                                const CovarianceOptions& options,
                                                double length_scale_m, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COVARIANCE_REGISTRATION_UNCERTAINTY_H_
