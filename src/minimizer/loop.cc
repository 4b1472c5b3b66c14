// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/loop.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "icpscape/cloud/displacement.h"
#include "icpscape/common/text.h"
#include "icpscape/minimizer/free_directions.h"

namespace icpscape::internal {
namespace {

// Smallest and largest over the free directions about the centroid, rotations in units of 1 /
// kRotationLength_m.
std::pair<double, double> ExtremeEigenvalues(const Mat6& hessian, const Vec3& centroid,
                                             const DofMask& free) {
  const Mat6 about_centroid = AboutPoint(centroid, kRotationLength_m);
  const Directions motions = about_centroid.inverse() * FreeDirections(free, about_centroid);
  const Eigen::MatrixXd scaled = motions.transpose() * hessian * motions;
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  return {eigenvalues[0], eigenvalues[motions.cols() - 1]};
}

// The longest period of a limit cycle that is looked for, and how much closer than a short step a
// pose must come to the one of a period before: slow convergence is no cycle.
constexpr std::size_t kLongestPeriod = 10;
constexpr double kSamePose = 0.1;

}  // namespace

Displacement Loop::Between(const SE3d& from, const SE3d& to) const {
  return DisplacementAt(centroid_, from.Inverse() * to);
}

Evaluation Loop::Reassociated(const SE3d& T, MatchesByMatcher* keep) {
  ++summary_.matching_passes;
  return objective_.Evaluate(T, options_.threads, keep);
}

NormalEquations Loop::FrozenCost(const SE3d& T, const MatchesByMatcher& matches) const {
  return objective_.Evaluate(T, matches, options_.threads, Derivatives::kNone).sums;
}

void Loop::Record(const SE3d& T, const Evaluation& evaluation, const MatchesByMatcher& matches) {
  Iterate iterate;
  iterate.T_target_source = T;
  iterate.cost = evaluation.sums.cost;
  iterate.rmse = evaluation.Rmse();
  iterate.n = evaluation.n();
  iterate.gradient_norm = evaluation.sums.gradient.norm();
  std::tie(iterate.smallest_eigenvalue, iterate.largest_eigenvalue) =
      ExtremeEigenvalues(evaluation.sums.Hessian(), centroid_, options_.free);
  if (!summary_.iterates.empty()) {
    const Displacement step = Between(summary_.iterates.back().T_target_source, T);
    iterate.step_m = step.m;
    iterate.step_rad = step.rad;
  }
  iterate.time_s = std::chrono::duration<double>(Clock::now() - start_).count();
  summary_.iterates.push_back(iterate);
  FindEnd(evaluation, matches);
}

void Loop::FindEnd(const Evaluation& evaluation, const MatchesByMatcher& matches) {
  const std::vector<Iterate>& iterates = summary_.iterates;
  const double cost = iterates.back().cost;
  if (Observed() && !options_.observer({iterates.back(), evaluation, matches})) {
    end_ = {Termination::kStopped, "The observer ended it."};
  } else if (options_.max_final_cost > 0 && cost <= options_.max_final_cost) {
    end_ = {Termination::kCostReached,
            "The cost is at most " + Number(options_.max_final_cost) + "."};
  } else if (options_.min_cost_change > 0 && iterates.size() > 1) {
    const double before = iterates[iterates.size() - 2].cost;
    if (std::abs(cost - before) < options_.min_cost_change * before) {
      end_ = {Termination::kCostChange,
              "The cost changed by less than a share of " + Number(options_.min_cost_change) + "."};
    }
  }
}

bool Loop::IsShort(double step_m, double step_rad) const {
  return step_m < options_.min_step_m && step_rad < options_.min_step_rad;
}

bool Loop::IsShortStepTo(const SE3d& T) const {
  const auto [step_m, step_rad] = Between(summary_.iterates.back().T_target_source, T);
  return IsShort(step_m, step_rad);
}

bool Loop::LastStepWasShort() const {
  return summary_.iterates.size() > 1 &&
         IsShort(summary_.iterates.back().step_m, summary_.iterates.back().step_rad);
}

std::size_t Loop::Period() const {
  const std::vector<Iterate>& iterates = summary_.iterates;
  const auto returned = [&](std::size_t last, std::size_t period) {
    const auto [step_m, step_rad] =
        Between(iterates[last - period].T_target_source, iterates[last].T_target_source);
    return IsShort(step_m / kSamePose, step_rad / kSamePose);
  };
  for (std::size_t period = 2; period <= kLongestPeriod && period + 2 < iterates.size(); ++period) {
    if (returned(iterates.size() - 1, period) && returned(iterates.size() - 2, period)) {
      return period;
    }
  }
  return 0;
}

MinimizerSummary Loop::End(Termination termination, std::string message) {
  summary_.termination = termination;
  summary_.message = std::move(message);
  return std::move(summary_);
}

MinimizerSummary Loop::EndShortStep(int rejected) {
  return rejected == 0
             ? End(Termination::kConverged, "The step from here is shorter than the limit.")
             : EndNoDescent();
}

MinimizerSummary Loop::EndNoCorrespondences() {
  return End(
      Termination::kNoCorrespondences,
      "No pair of points is left after " + std::to_string(summary_.iterates.size()) + " iterates.");
}

MinimizerSummary Loop::EndFlat() {
  return End(Termination::kFailure,
             "Every pair is an outlier under the loss, which is flat there; expected a larger "
             "scale or a better start.");
}

MinimizerSummary Loop::EndLimitCycle(std::size_t period) {
  std::vector<Iterate>& iterates = summary_.iterates;
  const auto first = iterates.end() - static_cast<std::ptrdiff_t>(period);
  const auto best = std::min_element(
      first, iterates.end(), [](const Iterate& a, const Iterate& b) { return a.rmse < b.rmse; });
  for (auto member = first; member != iterates.end(); ++member) {
    const auto [m, rad] = Between(best->T_target_source, member->T_target_source);
    summary_.cycle_m = std::max(summary_.cycle_m, m);
    summary_.cycle_rad = std::max(summary_.cycle_rad, rad);
  }
  iterates.erase(best + 1, iterates.end());
  return End(Termination::kLimitCycle,
             "The same " + std::to_string(period) + " poses came again; this is the best of them.");
}

MinimizerSummary Loop::EndMaxIterations() {
  return End(
      Termination::kMaxIterations,
      "The limit of " + std::to_string(options_.max_iterations) + " iterations was reached.");
}

MinimizerSummary Loop::EndNoDescent() {
  if (summary_.iterates.back().gradient_norm == 0) {
    return End(Termination::kConverged, "The gradient is zero.");
  }
  return End(Termination::kNoDescent, "No step lowered the cost any further.");
}

MinimizerSummary Loop::EndSolverFailure(std::string message) {
  return summary_.iterates.back().cost == 0 ? EndNoDescent()
                                            : End(Termination::kFailure, std::move(message));
}

}  // namespace icpscape::internal
