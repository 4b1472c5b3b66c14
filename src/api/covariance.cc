// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/api/covariance.h"

#include <utility>

namespace icpscape {

PairCovarianceOptions::PairCovarianceOptions() {
  metrics = {"point_to_point", "point_to_plane", "symmetric"};
}

const std::optional<Mat6>& CovarianceResult::Of(Estimator estimator) const {
  return covariances.at(static_cast<std::size_t>(estimator)).covariance;
}

std::vector<CovarianceResult> Covariance(PointCloud source, PointCloud target,
                                         const PairCovarianceOptions& options) {
  options.estimators.Check();
  const auto [scans, origins] = PrepareClouds(std::move(source), std::move(target), options);
  const ObjectiveSet set(scans, options.metrics, options.objective);
  std::vector<CovarianceResult> results;
  for (const Objective& objective : set.objectives()) {
    RegistrationUncertainty found =
        RegisterWithUncertainty(objective, origins.FromUser(options.T_initial), options.estimators,
                                options.length_scale_m, options.threads);
    CovarianceResult result;
    result.metric = objective.metric().name;
    result.T_target_source = origins.ToUser(found.registration.T_target_source());
    result.termination = found.registration.termination;
    VerdictOptions judge = options.verdict;
    judge.minimizer = PreciseMinimizer();
    judge.minimizer.threads = options.threads;
    result.verdict = JudgePose(objective, found.registration, judge);
    result.covariances = std::move(found.covariances);
    result.directions = found.directions;
    result.degeneracy = std::move(found.judgements);
    result.warning = CovarianceWarning(result.metric);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace icpscape
