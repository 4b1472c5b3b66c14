// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/metric_functions.h"

#include <ceres/loss_function.h>

#include <vector>

#include "residuals/adapters/ceres.h"
#include "residuals/registry.h"
#include "src/common/error.h"
#include "src/common/text.h"

namespace icpscape {
namespace {

template <class Metric>
bool Usable(const PairBlock& block, std::size_t pair) {
  return (Metric::kNeeds & ~block.provided[pair]) == 0;
}

template <class Metric, class Use>
void ForEachPair(const PairBlock& block, const Use& use) {
  for (std::size_t pair = 0; pair < block.size; ++pair) {
    if (Usable<Metric>(block, pair)) {
      use(Metric::From(block.pairs[pair]));
    }
  }
}

// J^T r.
template <class Residual, class Jacobian>
Vec6 Gradient(const Residual& r, const Jacobian& J) {
  Vec6 gradient = Vec6::Zero();
  for (int row = 0; row < J.rows(); ++row) {
    for (int i = 0; i < 6; ++i) {
      gradient[i] += J(row, i) * r[row];
    }
  }
  return gradient;
}

// Flattened: with everything inlined the compiler keeps a pair in registers.
template <class Metric, Derivatives kDerivatives>
__attribute__((flatten)) void EvaluateBlock(const PairBlock& block, const SE3d& T,
                                            const ceres::LossFunction* loss, Evaluation* sums) {
  // Without a loss and with eps a sum of squares, all sums follow from these.
  const bool plain = loss == nullptr && Metric::kEpsilon == Epsilon::kSquared;
  NormalEquations own;
  ForEachPair<Metric>(block, [&](const Metric& metric) {
    const auto r = metric.Residual(T);
    const double squared = r.squaredNorm();
    double rho[3] = {squared, 1, 0};
    EpsilonTerm term = {squared, 1};
    if (!plain) {
      if (loss != nullptr) {
        loss->Evaluate(squared, rho);
      }
      term = EvaluateEpsilon(Metric::kEpsilon, squared);
      sums->sum_squared += squared;
      sums->epsilon += term.value;
    }
    if constexpr (kDerivatives == Derivatives::kNone) {
      own.AddValue(rho);
    } else {
      const auto J = metric.Jacobian(T);
      if constexpr (kDerivatives == Derivatives::kHessian) {
        own.Add(r, J, rho);
      } else {
        own.AddValue(rho);
        own.gradient += rho[1] * Gradient(r, J);
      }
      if (!plain) {
        sums->epsilon_gradient += (2 * term.derivative) * Gradient(r, J);
      }
    }
  });
  sums->sums += own;
  if (plain) {
    sums->sum_squared += 2 * own.cost;
    sums->epsilon += 2 * own.cost;
    sums->epsilon_gradient += 2 * own.gradient;
  }
}

template <class Metric>
void Evaluate(const PairBlock& block, const SE3d& T, const ceres::LossFunction* loss,
              Derivatives derivatives, Evaluation* sums) {
  switch (derivatives) {
    case Derivatives::kNone:
      return EvaluateBlock<Metric, Derivatives::kNone>(block, T, loss, sums);
    case Derivatives::kGradient:
      return EvaluateBlock<Metric, Derivatives::kGradient>(block, T, loss, sums);
    case Derivatives::kHessian:
      return EvaluateBlock<Metric, Derivatives::kHessian>(block, T, loss, sums);
  }
}

template <class Metric>
ceres::CostFunction* MakeCost(const PairBlock& block, std::size_t pair) {
  return Usable<Metric>(block, pair) ? new CeresCost<Metric>(Metric::From(block.pairs[pair]))
                                     : nullptr;
}

template <class Metric>
constexpr MetricFunctions kFunctions = {Metric::kNeeds, Metric::kEpsilon, &Evaluate<Metric>,
                                        &MakeCost<Metric>};

}  // namespace

const MetricFunctions& MetricFunctionsOf(const std::string& metric) {
  const MetricFunctions* functions = nullptr;
  WithMetric(metric, [&](auto tag) { functions = &kFunctions<typename decltype(tag)::Metric>; });
  if (functions == nullptr) {
    std::vector<std::string> known;
    ForEachMetric([&](auto tag) { known.emplace_back(decltype(tag)::Metric::kName); });
    throw UsageError("unknown metric \"" + metric + "\": expected one of " + Join(known) + ".");
  }
  return *functions;
}

}  // namespace icpscape
