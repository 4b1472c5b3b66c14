// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/minimizer.h"

#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"
#include "icpscape/minimizer/loop.h"
#include "icpscape/residuals/adapters/ceres.h"

namespace icpscape {
namespace {

using internal::Loop;
using Parameters = std::array<double, 7>;

// The pose as Ceres sees it: through the parameters and back, so that both sides of the loop
// evaluate bit for bit the same pose.
Parameters ToParameters(const SE3d& T) {
  Parameters x;
  T.ToParameters(x.data());
  return x;
}

ceres::Problem::Options UnownedLoss() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

ceres::Solver::Options SolverOptions() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  // Only our own stop rules end the loop.
  options.function_tolerance = 0;
  options.gradient_tolerance = 0;
  options.parameter_tolerance = 0;
  // Next to no damping: as long as steps are accepted this is Gauss-Newton.
  options.initial_trust_region_radius = 1e8;
  return options;
}

class FunctionCallback final : public ceres::IterationCallback {
 public:
  using Function = std::function<ceres::CallbackReturnType(const ceres::IterationSummary&)>;
  explicit FunctionCallback(Function function) : function_(std::move(function)) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    return function_(summary);
  }

 private:
  Function function_;
};

bool Flat(const Evaluation& evaluation) {
  return evaluation.sums.cost > 0 && evaluation.sums.hessian.trace() == 0;
}

struct StepResult {
  bool accepted = false;  // False where no step lowers the frozen cost.
  int rejected = 0;       // Steps that were too long, before the one that was accepted.
  std::string failure;    // Not empty where Ceres gave up.
};

// One Ceres step on frozen matches.
StepResult Step(const JointObjective& objective, const Loop& loop, const MatchesByMatcher& matches,
                const Evaluation& at_start, Parameters* x) {
  ceres::Problem problem(UnownedLoss());
  ceres::Solver::Options options = SolverOptions();
  problem.AddParameterBlock(x->data(), 7, new SE3SubsetManifold(loop.options().free));
  if (objective.HasUpwardLoss()) {
    objective.AddResidualBlocks(matches, x->data(), &problem);
    options.num_threads = std::min(loop.options().threads, HardwareThreads());
  } else {
    bool first = true;
    problem.AddResidualBlock(new SquareRootCost([&, first](const SE3d& T) mutable {
                               // Ceres begins with the pose that was evaluated last. At the next
                               // pose it needs only the cost, to accept the step: before it asks
                               // for derivatives the pairs change.
                               return std::exchange(first, false) ? at_start.sums
                                                                  : loop.FrozenCost(T, matches);
                             }),
                             nullptr, x->data());
  }
  options.max_num_iterations = 10;  // Shorter and shorter steps, until one is accepted.
  FunctionCallback stop_after_first_step([](const ceres::IterationSummary& iteration) {
    return iteration.iteration > 0 && iteration.step_is_successful
               ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
               : ceres::SOLVER_CONTINUE;
  });
  options.callbacks.push_back(&stop_after_first_step);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  StepResult result;
  if (summary.termination_type == ceres::FAILURE) {
    result.failure = summary.message;
  }
  result.accepted = summary.num_successful_steps > 1;  // The start counts as one.
  result.rejected = summary.num_unsuccessful_steps;
  return result;
}

MinimizerSummary MinimizeEveryStep(const JointObjective& objective, Parameters x, Loop loop) {
  MatchesByMatcher matches;
  for (int iteration = 0;; ++iteration) {
    const SE3d T = SE3d::FromParameters(x.data());
    const Evaluation evaluation = loop.Reassociated(T, &matches);
    if (evaluation.n() == 0) {
      return loop.EndNoCorrespondences();
    }
    if (iteration == 0 && objective.HasUpwardLoss()) {
      LOG(WARNING) << "The loss curves upwards: one residual block per pair, which is slow.";
    }
    loop.Record(T, evaluation, matches);
    if (Flat(evaluation)) {
      return loop.EndFlat();
    }
    if (loop.Ended()) {
      return loop.EndHere();
    }
    if (const std::size_t period = loop.Period()) {
      return loop.EndLimitCycle(period);
    }
    if (iteration == loop.options().max_iterations) {
      return loop.EndMaxIterations();
    }
    const StepResult step = Step(objective, loop, matches, evaluation, &x);
    if (!step.accepted) {
      return step.failure.empty() ? loop.EndNoDescent() : loop.EndSolverFailure(step.failure);
    }
    // A short step is not taken: it would cost a matching pass to know the objective there.
    if (loop.IsShortStepTo(SE3d::FromParameters(x.data()))) {
      return loop.EndShortStep(step.rejected);
    }
  }
}

MinimizerSummary MinimizeEveryEvaluation(Parameters x, Loop loop) {
  struct {
    SE3d T;
    MatchesByMatcher matches;  // Where they are observed.
    Evaluation evaluation;
  } last;
  const auto evaluate = [&](const SE3d& T) {
    last.T = T;
    last.evaluation = loop.Reassociated(T, loop.Observed() ? &last.matches : nullptr);
  };
  evaluate(SE3d::FromParameters(x.data()));
  if (last.evaluation.n() == 0) {
    return loop.EndNoCorrespondences();
  }
  if (Flat(last.evaluation)) {
    loop.Record(last.T, last.evaluation, last.matches);
    return loop.EndFlat();
  }
  bool first = true;
  ceres::Problem problem;
  problem.AddParameterBlock(x.data(), 7, new SE3SubsetManifold(loop.options().free));
  problem.AddResidualBlock(new SquareRootCost([&](const SE3d& T) {
                             if (!std::exchange(first, false)) {
                               evaluate(T);
                             }
                             NormalEquations sums = last.evaluation.sums;
                             if (sums.num_correspondences == 0) {
                               // No pair is no perfect fit: refuse the pose.
                               sums.cost = std::numeric_limits<double>::quiet_NaN();
                             }
                             return sums;
                           }),
                           nullptr, x.data());
  ceres::Solver::Options options = SolverOptions();
  options.max_num_iterations = loop.options().max_iterations;
  options.use_nonmonotonic_steps = true;
  int rejected = 0;
  FunctionCallback record([&](const ceres::IterationSummary& iteration) {
    // The problem's own parameters are the best so far, not the current ones: under non-monotone
    // steps these are the pose evaluated last.
    if (iteration.iteration == 0 || iteration.step_is_successful) {
      loop.Record(last.T, last.evaluation, last.matches);
      if (loop.Ended() || loop.LastStepWasShort()) {
        return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
      }
      rejected = 0;
    } else {
      ++rejected;
    }
    return ceres::SOLVER_CONTINUE;
  });
  options.callbacks.push_back(&record);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  std::vector<Iterate>* iterates = loop.iterates();
  if (iterates->empty()) {
    return loop.End(Termination::kFailure, summary.message);
  }
  const bool short_step = loop.LastStepWasShort();
  // Ceres returns the pose of least cost: what came after it was an excursion.
  const auto best =
      std::min_element(iterates->begin(), iterates->end(),
                       [](const Iterate& a, const Iterate& b) { return a.cost < b.cost; });
  iterates->erase(best + 1, iterates->end());
  if (loop.Ended()) {
    return loop.EndHere();
  }
  if (short_step) {
    return loop.EndShortStep(rejected);
  }
  switch (summary.termination_type) {
    case ceres::NO_CONVERGENCE:
      return loop.EndMaxIterations();
    case ceres::CONVERGENCE:
      return loop.EndNoDescent();
    default:
      return loop.EndSolverFailure(summary.message);
  }
}

}  // namespace

MinimizerSummary Minimize(const JointObjective& objective, const SE3d& T_start,
                          const MinimizerOptions& options) {
  if (options.free == DofMask{}) {
    throw UsageError("No direction is free; expected at least one.");
  }
  const Parameters x = ToParameters(T_start);
  Loop loop(objective, options);
  return options.reassociation == Reassociation::kEveryStep
             ? MinimizeEveryStep(objective, x, std::move(loop))
             : MinimizeEveryEvaluation(x, std::move(loop));
}

}  // namespace icpscape
