// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/api/register.h"

#include <cmath>
#include <utility>

#include "icpscape/objective/joint_objective.h"

namespace icpscape {

RegisterOptions::RegisterOptions() {
  metrics = {"point_to_plane"};
  minimizer.min_step_rad = 1e-3 * M_PI / 180;
}

RegisterResult Register(PointCloud source, PointCloud target, const RegisterOptions& options) {
  const auto [set, origins] = ObjectivesOf(std::move(source), std::move(target), options);
  const JointObjective objective(set.objectives(), options.weights);
  MinimizerOptions minimizer = options.minimizer;
  minimizer.threads = options.threads;
  MinimizerSummary summary = Minimize(objective, origins.FromUser(options.T_initial), minimizer);
  VerdictOptions judge = options.verdict;
  judge.minimizer = minimizer;
  RegisterResult result;
  result.verdict = JudgePose(objective, summary, judge);
  result.T_target_source = options.T_initial;
  result.termination = summary.termination;
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
