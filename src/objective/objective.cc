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

// The metric of source point i and its match, or false where a normal it needs is missing.
template <class Metric>
bool MakeMetric(const Matcher& matcher, const Matches& matches, std::size_t i, Metric* metric) {
  const auto j = static_cast<std::size_t>(matches.target_index[i]);
  Correspondence c;
  c.p_source = matcher.source().Point(i);
  if constexpr ((Metric::kNeeds & kSourceNormal) != 0) {
    if (!matcher.source().NormalIsValid(i)) {
      return false;
    }
    c.n_source = matcher.source().Normal(i);
  }
  if constexpr ((Metric::kNeeds & kTargetNormal) != 0) {
    if (!matcher.target().NormalIsValid(j)) {
      return false;
    }
    c.n_target = matcher.target().Normal(j);
  }
  if constexpr ((Metric::kNeeds & kTargetLine) != 0) {
    c.a_line = matches.fits[i].anchor;
    c.d_line = matches.fits[i].direction;
  } else if constexpr ((Metric::kNeeds & kTargetPatch) != 0) {
    c.q_patch = matches.fits[i].anchor;
    c.n_patch = matches.fits[i].direction;
    c.area_patch = matches.area_patch;
  } else {
    c.q_target = matcher.target().Point(j);
  }
  *metric = Metric::From(c);
  return true;
}

// Calls use(metric) for every usable pair whose source index is in [begin, end), in order.
template <class Metric, class Use>
void ForEachPair(const Matcher& matcher, const Matches& matches, std::size_t begin, std::size_t end,
                 const Use& use) {
  for (std::size_t i = begin; i < end; ++i) {
    Metric metric;
    if (matches.target_index[i] >= 0 && MakeMetric(matcher, matches, i, &metric)) {
      use(metric);
    }
  }
}

template <class Metric>
Evaluation EvaluateRange(const Matcher& matcher, const Matches& matches, const SE3d& T,
                         const ceres::LossFunction* loss, std::size_t begin, std::size_t end) {
  Evaluation out;
  if (loss == nullptr && Metric::kEpsilon == Epsilon::kSquared) {
    ForEachPair<Metric>(matcher, matches, begin, end,
                        [&](const Metric& metric) { Accumulate(metric, T, &out.sums); });
    out.sum_squared = out.epsilon = 2 * out.sums.cost;
    out.epsilon_gradient = 2 * out.sums.gradient;
    return out;
  }
  ForEachPair<Metric>(matcher, matches, begin, end, [&](const Metric& metric) {
    const auto r = metric.Residual(T);
    const auto J = metric.Jacobian(T);
    const double squared = r.squaredNorm();
    double rho[3] = {squared, 1, 0};
    if (loss != nullptr) {
      loss->Evaluate(squared, rho);
    }
    out.sums.Add(r, J, rho);
    out.sum_squared += squared;
    const EpsilonTerm term = EvaluateEpsilon(Metric::kEpsilon, squared);
    out.epsilon += term.value;
    out.epsilon_gradient += (2 * term.derivative) * (J.transpose() * r);
  });
  return out;
}

template <class Metric>
void AddBlocks(const Matcher& matcher, const Matches& matches, const ceres::LossFunction* loss,
               double* x, ceres::Problem* problem) {
  // Ceres takes a mutable pointer but never changes the loss; the caller sees to the ownership.
  auto* shared_loss = const_cast<ceres::LossFunction*>(loss);
  ForEachPair<Metric>(matcher, matches, 0, matcher.source().size(), [&](const Metric& metric) {
    problem->AddResidualBlock(new CeresCost<Metric>(metric), shared_loss, x);
  });
}

}  // namespace

void Evaluation::Add(const Evaluation& other, double weight) {
  NormalEquations scaled = other.sums;
  scaled.Scale(weight);
  sums += scaled;
  sum_squared += weight * other.sum_squared;
  epsilon += weight * other.epsilon;
  epsilon_gradient += weight * other.epsilon_gradient;
}

double Evaluation::Rmse() const { return std::sqrt(epsilon / static_cast<double>(n())); }

double Evaluation::RmsResidual() const { return std::sqrt(sum_squared / static_cast<double>(n())); }

double Evaluation::RmseSlope(const Vec6& body_twist) const {
  return epsilon_gradient.dot(body_twist) / (2 * static_cast<double>(n()) * Rmse());
}

struct Objective::MetricFunctions {
  Evaluation (*evaluate)(const Matcher&, const Matches&, const SE3d&, const ceres::LossFunction*,
                         std::size_t, std::size_t);
  void (*add_blocks)(const Matcher&, const Matches&, const ceres::LossFunction*, double*,
                     ceres::Problem*);
  unsigned needs;
  Epsilon epsilon;

  template <class Metric>
  static const MetricFunctions* Of() {
    static constexpr MetricFunctions functions = {&EvaluateRange<Metric>, &AddBlocks<Metric>,
                                                  Metric::kNeeds, Metric::kEpsilon};
    return &functions;
  }
};

Objective::Objective(const std::string& metric, const Matcher& matcher,
                     std::shared_ptr<const ceres::LossFunction> loss)
    : metric_(metric), matcher_(&matcher), loss_(std::move(loss)), functions_(nullptr) {
  CheckMetricName(metric);
  WithMetric(metric,
             [&](auto tag) { functions_ = MetricFunctions::Of<typename decltype(tag)::Metric>(); });
  if (loss_ == nullptr && functions_->epsilon == Epsilon::kSoftNorm) {
    loss_ = std::make_shared<ceres::SoftLOneLoss>(1);
  }
  CHECK_EQ(functions_->needs & ~matcher.Provides(), 0U)
      << metric << " needs more than its matcher provides";
  CHECK((functions_->needs & kSourceNormal) == 0 || matcher.source().has_normals())
      << metric << " needs normals in the source cloud";
  CHECK((functions_->needs & kTargetNormal) == 0 || matcher.target().has_normals())
      << metric << " needs normals in the target cloud";
}

Matches Objective::Match(const SE3d& T_target_source, int threads) const {
  Matches matches;
  matcher_->Match(T_target_source, threads, &matches);
  return matches;
}

Evaluation Objective::Evaluate(const SE3d& T_target_source, const Matches& matches,
                               int threads) const {
  const std::size_t size = matcher_->source().size();
  CHECK_EQ(matches.target_index.size(), size);
  std::vector<Evaluation> parts((size + kChunk - 1) / kChunk);
  ParallelFor(parts.size(), threads, [&](std::size_t part) {
    const std::size_t end = std::min(size, (part + 1) * kChunk);
    parts[part] =
        functions_->evaluate(*matcher_, matches, T_target_source, loss_.get(), part * kChunk, end);
  });
  Evaluation sum;
  for (const Evaluation& part : parts) {
    sum.Add(part, 1);
  }
  return sum;
}

Evaluation Objective::Evaluate(const SE3d& T_target_source, int threads) const {
  return Evaluate(T_target_source, Match(T_target_source, threads), threads);
}

void Objective::AddResidualBlocks(const Matches& matches, const ceres::LossFunction* loss,
                                  double* x, ceres::Problem* problem) const {
  functions_->add_blocks(*matcher_, matches, loss, x, problem);
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

Epsilon MetricEpsilon(const std::string& metric) {
  CheckMetricName(metric);
  Epsilon epsilon = Epsilon::kSquared;
  WithMetric(metric, [&](auto tag) { epsilon = decltype(tag)::Metric::kEpsilon; });
  return epsilon;
}

}  // namespace icpscape
