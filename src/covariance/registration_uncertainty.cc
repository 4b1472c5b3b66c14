// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/registration_uncertainty.h"

#include "icpscape/common/error.h"
#include "icpscape/objective/source_centroid.h"

namespace icpscape {
namespace {

// Why an estimator has no covariance.
std::string Reason(Estimator estimator, const CovarianceSums& sums, bool is_determined) {
  if (!is_determined) {
    return "the pairs do not determine all six degrees of freedom";
  }
  if (!(sums.cost > 0)) {
    return "all residuals are zero, and with them the noise that they tell of";
  }
  if (estimator == Estimator::kCensiRingBias && !sums.ring_bias) {
    return "the clouds carry no ring numbers (those of KITTI's scans are recovered for edges and "
           "planar points alone)";
  }
  if (estimator == Estimator::kSandwichRematched && sums.clusters > 6) {
    return "where the pairs follow the pose, the cost has no minimum here";
  }
  return "there is too little to estimate it from";
}

}  // namespace

MinimizerOptions PreciseMinimizer() {
  MinimizerOptions options;
  options.max_iterations = 100;
  options.min_step_m = 1e-5;
  options.min_step_rad = 1e-6;
  return options;
}

RegistrationUncertainty RegisterWithUncertainty(const Objective& objective, const SE3d& T_start,
                                                const CovarianceOptions& options,
                                                double length_scale_m, int threads) {
  MinimizerOptions minimizer = PreciseMinimizer();
  minimizer.threads = threads;
  RegistrationUncertainty result;
  result.registration = Minimize(objective, T_start, minimizer);
  if (!result.registration.Usable()) {
    throw ComputationError(objective.metric().name + ": " + result.registration.message);
  }
  const SE3d& T = result.registration.T_target_source();
  result.sums = SumForCovariance(objective, T, options, threads);
  result.directions =
      EigenDirectionsOf(result.sums.gauss_newton, SourceCentroid(objective), length_scale_m);
  const bool is_determined =
      result.directions.eigenvalues[0] > 1e-12 * result.directions.eigenvalues[5];
  for (const Estimator estimator : AllOf<Estimator>()) {
    EstimatedCovariance entry;
    entry.estimator = estimator;
    entry.covariance = EstimateCovariance(estimator, result.sums, options);
    if (!entry.covariance) {
      entry.reason = Reason(estimator, result.sums, is_determined);
    }
    result.covariances.push_back(entry);
  }
  const Vec3& sensor = objective.matcher().source().sensor;
  result.judgements =
      JudgeDegeneracy(HessianAbout(sensor, 1, result.sums.gauss_newton),
                      PlaneConstraintsOf(objective, T, objective.Match(T, threads)));
  return result;
}

}  // namespace icpscape
