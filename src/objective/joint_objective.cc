// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/joint_objective.h"

#include <ceres/loss_function.h>
#include <algorithm>
#include <utility>

#include "src/common/error.h"
#include "src/common/text.h"

namespace icpscape {

JointObjective::JointObjective(std::vector<Term> terms) : terms_(std::move(terms)) {
  for (const Term& term : terms_) {
    if (!(term.weight > 0)) {
      throw UsageError("weight " + Number(term.weight) + " of " + term.objective->metric().name +
                       ": expected a positive number.");
    }
    objectives_.push_back(term.objective);
    // Ceres takes a mutable pointer but never changes the loss.
    scaled_losses_.push_back(std::make_unique<ceres::ScaledLoss>(
        const_cast<ceres::LossFunction*>(term.objective->loss()), term.weight,
        ceres::DO_NOT_TAKE_OWNERSHIP));
  }
}

JointObjective::~JointObjective() = default;
JointObjective::JointObjective(JointObjective&&) noexcept = default;
JointObjective& JointObjective::operator=(JointObjective&&) noexcept = default;

std::string JointObjective::Name() const {
  std::vector<std::string> names;
  for (const Term& term : terms_) {
    names.push_back(term.objective->metric().name);
  }
  return Join(names, " + ");
}

MatchesByMatcher JointObjective::Match(const SE3d& T_target_source, int threads) const {
  return MatchAll(objectives_, T_target_source, threads);
}

Evaluation JointObjective::WeightedSum(const std::vector<Evaluation>& evaluations) const {
  Evaluation sum;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    sum.Add(evaluations[k], terms_[k].weight);
  }
  return sum;
}

Evaluation JointObjective::Evaluate(const SE3d& T_target_source, const MatchesByMatcher& matches,
                                    int threads, Derivatives derivatives) const {
  return WeightedSum(EvaluateAll(objectives_, T_target_source, matches, derivatives, threads));
}

Evaluation JointObjective::Evaluate(const SE3d& T_target_source, int threads,
                                    MatchesByMatcher* keep) const {
  return WeightedSum(
      EvaluateAll(objectives_, T_target_source, Derivatives::kHessian, threads, keep));
}

bool JointObjective::HasUpwardLoss() const {
  return std::any_of(terms_.begin(), terms_.end(),
                     [](const Term& term) { return term.objective->HasUpwardLoss(); });
}

void JointObjective::AddResidualBlocks(const MatchesByMatcher& matches, double* x,
                                       ceres::Problem* problem) const {
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    terms_[k].objective->AddResidualBlocks(matches.at(&terms_[k].objective->matcher()),
                                           scaled_losses_[k].get(), x, problem);
  }
}

}  // namespace icpscape
