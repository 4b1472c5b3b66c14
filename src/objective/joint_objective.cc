// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/joint_objective.h"

#include <ceres/loss_function.h>
#include <algorithm>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {

JointObjective::JointObjective(std::vector<Objective> objectives, std::vector<double> weights)
    : objectives_(std::move(objectives)), weights_(std::move(weights)) {
  if (weights_.empty()) {
    weights_.assign(objectives_.size(), 1);
  }
  if (weights_.size() != objectives_.size()) {
    throw UsageError(std::to_string(weights_.size()) + " weights for " +
                     std::to_string(objectives_.size()) +
                     " objectives; expected one for each, or none.");
  }
  for (std::size_t k = 0; k < objectives_.size(); ++k) {
    const Objective& objective = objectives_[k];
    if (!(weights_[k] > 0)) {
      throw UsageError("weight " + Number(weights_[k]) + " of " + objective.metric().name +
                       ": expected a positive number.");
    }
    pointers_.push_back(&objective);
    // Ceres takes a mutable pointer but never changes the loss.
    scaled_losses_.push_back(
        std::make_unique<ceres::ScaledLoss>(const_cast<ceres::LossFunction*>(objective.loss()),
                                            weights_[k], ceres::DO_NOT_TAKE_OWNERSHIP));
  }
}

JointObjective::~JointObjective() = default;
JointObjective::JointObjective(JointObjective&&) noexcept = default;
JointObjective& JointObjective::operator=(JointObjective&&) noexcept = default;

std::string JointObjective::Name() const {
  std::vector<std::string> names;
  for (const Objective& objective : objectives_) {
    names.push_back(objective.metric().name);
  }
  return Join(names, " + ");
}

MatchesByMatcher JointObjective::Match(const SE3d& T_target_source, int threads) const {
  return MatchAll(pointers_, T_target_source, threads);
}

Evaluation JointObjective::WeightedSum(const std::vector<Evaluation>& evaluations) const {
  Evaluation sum;
  for (std::size_t k = 0; k < objectives_.size(); ++k) {
    sum.Add(evaluations[k], weights_[k]);
  }
  return sum;
}

Evaluation JointObjective::Evaluate(const SE3d& T_target_source, const MatchesByMatcher& matches,
                                    int threads, Derivatives derivatives) const {
  return WeightedSum(EvaluateAll(pointers_, T_target_source, matches, derivatives, threads));
}

Evaluation JointObjective::Evaluate(const SE3d& T_target_source, int threads,
                                    MatchesByMatcher* keep) const {
  return WeightedSum(EvaluateAll(pointers_, T_target_source, Derivatives::kHessian, threads, keep));
}

bool JointObjective::HasUpwardLoss() const {
  return std::any_of(objectives_.begin(), objectives_.end(),
                     [](const Objective& objective) { return objective.HasUpwardLoss(); });
}

void JointObjective::AddResidualBlocks(const MatchesByMatcher& matches, double* x,
                                       ceres::Problem* problem) const {
  for (std::size_t k = 0; k < objectives_.size(); ++k) {
    objectives_[k].AddResidualBlocks(matches.at(&objectives_[k].matcher()), scaled_losses_[k].get(),
                                     x, problem);
  }
}

}  // namespace icpscape
