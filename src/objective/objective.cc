// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/objective.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "residuals/adapters/ceres.h"
#include "residuals/registry.h"
#include "src/common/error.h"
#include "src/common/parallel.h"
#include "src/common/text.h"

namespace icpscape {
namespace {

// Fixed, so that sums are formed in the same order for any number of threads.
constexpr std::size_t kChunk = 4096;

struct Inputs {
  const PointCloud& source;
  const PointCloud& target;
  const Matches& matches;
};

// The metric of pair (i, j), or false where a normal it needs is missing.
template <class Metric>
bool MakeMetric(const PointCloud& source, const PointCloud& target, std::size_t i, std::size_t j,
                Metric* metric) {
  Correspondence c;
  c.p_source = source.Point(i);
  c.q_target = target.Point(j);
  if constexpr ((Metric::kNeeds & kSourceNormal) != 0) {
    if (!source.NormalIsValid(i)) {
      return false;
    }
    c.n_source = source.Normal(i);
  }
  if constexpr ((Metric::kNeeds & kTargetNormal) != 0) {
    if (!target.NormalIsValid(j)) {
      return false;
    }
    c.n_target = target.Normal(j);
  }
  *metric = Metric::From(c);
  return true;
}

// Calls use(metric) for every usable pair whose source index is in [begin, end), in order.
template <class Metric, class Use>
void ForEachPair(const Inputs& in, std::size_t begin, std::size_t end, const Use& use) {
  for (std::size_t i = begin; i < end; ++i) {
    const int j = in.matches.target_index[i];
    Metric metric;
    if (j >= 0 && MakeMetric(in.source, in.target, i, static_cast<std::size_t>(j), &metric)) {
      use(metric);
    }
  }
}

template <class Metric>
Evaluation EvaluateRange(const Inputs& in, const SE3d& T, const ceres::LossFunction* loss,
                         std::size_t begin, std::size_t end) {
  Evaluation out;
  if (loss == nullptr) {
    ForEachPair<Metric>(in, begin, end,
                        [&](const Metric& metric) { Accumulate(metric, T, &out.sums); });
    out.sum_squared = 2 * out.sums.cost;
    out.epsilon_gradient = 2 * out.sums.gradient;
  } else {
    ForEachPair<Metric>(in, begin, end, [&](const Metric& metric) {
      const auto r = metric.Residual(T);
      const auto J = metric.Jacobian(T);
      const double squared = r.squaredNorm();
      double rho[3];
      loss->Evaluate(squared, rho);
      out.sums.Add(r, J, rho);
      out.sum_squared += squared;
      out.epsilon_gradient += 2 * (J.transpose() * r);
    });
  }
  out.epsilon = out.sum_squared;
  return out;
}

template <class Metric>
void AddBlocks(const Inputs& in, const ceres::LossFunction* loss, double* x,
               ceres::Problem* problem) {
  // Ceres takes a mutable pointer but never changes the loss; the caller sees to the ownership.
  auto* shared_loss = const_cast<ceres::LossFunction*>(loss);
  ForEachPair<Metric>(in, 0, in.source.size(), [&](const Metric& metric) {
    problem->AddResidualBlock(new CeresCost<Metric>(metric), shared_loss, x);
  });
}

void Add(const Evaluation& part, Evaluation* sum) {
  sum->sums += part.sums;
  sum->sum_squared += part.sum_squared;
  sum->epsilon += part.epsilon;
  sum->epsilon_gradient += part.epsilon_gradient;
}

}  // namespace

double Evaluation::Rmse() const { return std::sqrt(epsilon / static_cast<double>(n())); }

double Evaluation::RmsResidual() const { return std::sqrt(sum_squared / static_cast<double>(n())); }

double Evaluation::RmseSlope(const Vec6& body_twist) const {
  return epsilon_gradient.dot(body_twist) / (2 * static_cast<double>(n()) * Rmse());
}

struct Objective::MetricFunctions {
  Evaluation (*evaluate)(const Inputs&, const SE3d&, const ceres::LossFunction*, std::size_t,
                         std::size_t);
  void (*add_blocks)(const Inputs&, const ceres::LossFunction*, double*, ceres::Problem*);
  unsigned needs;

  template <class Metric>
  static const MetricFunctions* Of() {
    static constexpr MetricFunctions functions = {&EvaluateRange<Metric>, &AddBlocks<Metric>,
                                                  Metric::kNeeds};
    return &functions;
  }
};

Objective::Objective(const std::string& metric, const PointCloud& source, const PointCloud& target,
                     const ClosestPointMatcher& matcher,
                     std::shared_ptr<const ceres::LossFunction> loss)
    : metric_(metric),
      source_(&source),
      target_(&target),
      matcher_(&matcher),
      loss_(std::move(loss)),
      functions_(nullptr) {
  CheckMetricName(metric);
  WithMetric(metric,
             [&](auto tag) { functions_ = MetricFunctions::Of<typename decltype(tag)::Metric>(); });
  CHECK((functions_->needs & kSourceNormal) == 0 || source.has_normals())
      << metric << " needs normals in the source cloud";
  CHECK((functions_->needs & kTargetNormal) == 0 || target.has_normals())
      << metric << " needs normals in the target cloud";
}

Matches Objective::Match(const SE3d& T_target_source, int threads) const {
  Matches matches;
  matcher_->Match(*source_, T_target_source, threads, &matches);
  return matches;
}

Evaluation Objective::Evaluate(const SE3d& T_target_source, const Matches& matches,
                               int threads) const {
  CHECK_EQ(matches.target_index.size(), source_->size());
  const Inputs in{*source_, *target_, matches};
  std::vector<Evaluation> parts((source_->size() + kChunk - 1) / kChunk);
  ParallelFor(parts.size(), threads, [&](std::size_t part) {
    const std::size_t end = std::min(source_->size(), (part + 1) * kChunk);
    parts[part] = functions_->evaluate(in, T_target_source, loss_.get(), part * kChunk, end);
  });
  Evaluation sum;
  for (const Evaluation& part : parts) {
    Add(part, &sum);
  }
  return sum;
}

Evaluation Objective::Evaluate(const SE3d& T_target_source, int threads) const {
  return Evaluate(T_target_source, Match(T_target_source, threads), threads);
}

void Objective::AddResidualBlocks(const Matches& matches, double* x,
                                  ceres::Problem* problem) const {
  functions_->add_blocks({*source_, *target_, matches}, loss_.get(), x, problem);
}

void CheckMetricName(const std::string& metric) {
  if (!WithMetric(metric, [](auto) {})) {
    std::vector<std::string> known;
    ForEachMetric([&](auto tag) { known.emplace_back(decltype(tag)::Metric::kName); });
    throw UsageError("unknown metric \"" + metric + "\": expected one of " + Join(known) + ".");
  }
}

unsigned MetricNeeds(const std::string& metric) {
  CheckMetricName(metric);
  unsigned needs = 0;
  WithMetric(metric, [&](auto tag) { needs = decltype(tag)::Metric::kNeeds; });
  return needs;
}

}  // namespace icpscape
