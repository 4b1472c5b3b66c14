// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/api/register.h"

#include <cmath>
#include <utility>

namespace icpscape {

RegisterOptions::RegisterOptions() {
  metrics = {"point_to_plane"};
  minimizer.min_step_rad = 1e-3 * M_PI / 180;
}

RegisterOptions RegisterOptions::Robust() {
  RegisterOptions options;
  options.preset = Preset::kRobust;
  options.preparation.normals.num_neighbors = kRobustNormalNeighbors;
  return options;
}

RegisterResult Register(PointCloud source, PointCloud target, const RegisterOptions& options) {
  MinimizerOptions minimizer = options.minimizer;
  minimizer.threads = options.threads;
  const auto [scans, origins] = PrepareClouds(std::move(source), std::move(target), options);
  const Registration registration(scans, options.metrics, options.weights, options.objective,
                                  options.preset, options.threads);
  Registered registered = registration.Run(origins.FromUser(options.T_initial), minimizer);
  MinimizerSummary& summary = registered.summary;
  VerdictOptions judge = options.verdict;
  judge.minimizer = minimizer;
  RegisterResult result;
  result.verdict = JudgePose(registered.objective, summary, judge);
  result.T_target_source = options.T_initial;
  result.termination = summary.termination;
  result.stages = std::move(registered.stages);
  result.message = std::move(summary.message);
  result.iterates = std::move(summary.iterates);
  for (Iterate& iterate : result.iterates) {
    iterate.T_target_source = origins.ToUser(iterate.T_target_source);
  }
  if (result.Usable()) {
    const Iterate& last = result.iterates.back();
    result.T_target_source = last.T_target_source;
    result.cost = last.cost;
    result.rmse = last.rmse;
    result.num_pairs = last.n;
  }
  return result;
}

}  // namespace icpscape
