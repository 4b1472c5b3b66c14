// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/objective.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <cmath>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/objective/pass.h"
#include "icpscape/simd/level.h"

namespace icpscape {
namespace {

struct TermsContext {
  const ceres::LossFunction* loss;
  Epsilon epsilon;
};

void EvaluateTerms(const void* opaque, const double squared[8], BlockTerms::Values* values) {
  const auto* context = static_cast<const TermsContext*>(opaque);
  for (int i = 0; i < 8; ++i) {
    double rho[3] = {squared[i], 1, 0};
    if (context->loss != nullptr) {
      context->loss->Evaluate(squared[i], rho);
    }
    const EpsilonTerm term = EvaluateEpsilon(context->epsilon, squared[i]);
    values->rho[i] = rho[0];
    values->rho_slope[i] = rho[1];
    values->rho_curvature[i] = rho[2];
    values->epsilon[i] = term.value;
    values->epsilon_slope[i] = term.derivative;
  }
}

}  // namespace

Objective::Objective(const RegisteredMetric& metric, const Matcher& matcher,
                     std::shared_ptr<const ceres::LossFunction> loss)
    : metric_(&metric),
      matcher_(&matcher),
      loss_(std::move(loss)),
      kernel_(BlockKernelOf(metric.place, ActiveSimdLevel())) {
  if (loss_ == nullptr && metric.epsilon == Epsilon::kSoftNorm) {
    loss_ = std::make_shared<ceres::SoftLOneLoss>(1);
  }
  if ((metric.needs & ~matcher.Provides()) != 0) {
    throw UsageError(metric.name +
                     " needs more than its matcher provides; expected another matcher.");
  }
  ForEachQuantity<double>([&](auto row) {
    using Row = decltype(row);
    if constexpr (Row::kCanBeMissing) {
      const PointCloud& cloud = Row::kInSourceFrame ? matcher.source() : matcher.target();
      if (Row::IsNeededBy(metric.needs) && !cloud.Carries(typename Row::Kind())) {
        throw UsageError(metric.name + " needs " + NeedsText(Row::kNeed) + "; the " +
                         (Row::kInSourceFrame ? "source" : "target") + " cloud has none.");
      }
    }
  });
}

Objective::Objective(const std::string& metric, const Matcher& matcher,
                     std::shared_ptr<const ceres::LossFunction> loss)
    : Objective(MetricNamed(metric), matcher, std::move(loss)) {}

Matches Objective::Match(const SE3d& T_target_source, int threads) const {
  Matches matches;
  matcher_->Match(T_target_source, threads, &matches);
  return matches;
}

Evaluation Objective::Evaluate(const SE3d& T_target_source, const Matches& matches,
                               int threads) const {
  return EvaluateAll({this}, T_target_source, {{matcher_, matches}}, Derivatives::kHessian, threads)
      .front();
}

Evaluation Objective::Evaluate(const SE3d& T_target_source, int threads) const {
  return EvaluateAll({this}, T_target_source, Derivatives::kHessian, threads).front();
}

void Objective::Add(const PairBlock& block, const SE3d& T, Derivatives derivatives,
                    Evaluation* sums) const {
  const TermsContext context = {loss_.get(), metric_->epsilon};
  const BlockTerms terms = {&EvaluateTerms, &context};
  const bool plain = loss_ == nullptr && metric_->epsilon == Epsilon::kSquared;
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = T.R();
  BlockSums block_sums = {};
  kernel_(block.values(), R.data(), T.t().data(), derivatives, plain ? nullptr : &terms,
          &block_sums);
  sums->Add(block_sums);
}

void Objective::AddResidualBlocks(const Matches& matches, const ceres::LossFunction* loss,
                                  double* x, ceres::Problem* problem) const {
  // Ceres takes a mutable pointer but never changes the loss; the caller sees to the ownership.
  auto* shared_loss = const_cast<ceres::LossFunction*>(loss);
  const std::vector<std::int32_t>& order = matcher_->Order();
  PairBlock block;
  for (std::size_t k = 0; k < order.size(); ++k) {
    block.Fill(*matcher_, matches, k, k + 1, needs(),
               [&](std::size_t) { return static_cast<std::size_t>(order[k]); });
    if (const std::optional<Correspondence> pair = block.Pair(0, needs())) {
      problem->AddResidualBlock(metric_->make_cost(*pair), shared_loss, x);
    }
  }
}

bool Objective::HasUpwardLoss() const {
  for (int i = 0; loss_ != nullptr && i <= 24 * 64; ++i) {
    double rho[3];
    loss_->Evaluate(std::pow(10.0, -12 + i / 64.0), rho);
    if (rho[2] > 0) {
      return true;
    }
  }
  return false;
}

}  // namespace icpscape
