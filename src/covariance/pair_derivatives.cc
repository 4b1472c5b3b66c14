// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/pair_derivatives.h"

#include <ceres/jet.h>
#include <ceres/loss_function.h>

#include <type_traits>

#include "icpscape/residuals/registry.h"

namespace icpscape {
namespace {

// Six for the pose, then one for each range.
constexpr int kSourceRange = 6;
constexpr int kTargetRange = 7;
using Jet = ceres::Jet<double, 8>;

// The same metric over another scalar.
template <class Metric>
struct OverJets;
template <template <class> class Metric, class Scalar>
struct OverJets<Metric<Scalar>> {
  using Type = Metric<Jet>;
};

// Points move along the ray of their side as its range grows; all else is constant.
CorrespondenceOf<Jet> WithRanges(const Correspondence& pair, unsigned needs,
                                 const Sensors& sensors) {
  const Vec3 source_ray = (pair.p_source - sensors.source).normalized();
  const Vec3 target_ray = (pair.q_target - sensors.target).normalized();
  return MapQuantities<Jet>(pair, needs, [&](auto row, const auto& value) {
    using Row = decltype(row);
    using Kind = typename Row::Kind;
    return Kind::template Make<Jet>([&](std::size_t k) {
      Jet number(Kind::template NumberOf<double>(value, k));
      if constexpr (std::is_same_v<Kind, kind::Point>) {
        const auto axis = static_cast<Eigen::Index>(k);
        number.v[Row::kInSourceFrame ? kSourceRange : kTargetRange] =
            Row::kInSourceFrame ? source_ray[axis] : target_ray[axis];
      }
      return number;
    });
  });
}

template <class Metric>
PairDerivatives Differentiate(const Correspondence& pair, const SE3d& T,
                              const ceres::LossFunction* loss, const Sensors& sensors) {
  Vec<Jet, 6> xi;
  for (int i = 0; i < 6; ++i) {
    xi[i] = Jet(0.0, i);
  }
  const SE3<Jet> T_moved = T.cast<Jet>() * SE3<Jet>::Exp(xi);
  const auto metric = OverJets<Metric>::Type::From(WithRanges(pair, Metric::kNeeds, sensors));
  const Vec<Jet, Metric::kDim> r = metric.Residual(T_moved);
  const Mat<Jet, Metric::kDim, 6> J = metric.Jacobian(T_moved);
  const Jet squared = r.squaredNorm();
  double rho[3] = {squared.a, 1, 0};
  if (loss != nullptr) {
    loss->Evaluate(squared.a, rho);
  }
  const Jet weight(rho[1], rho[2] * squared.v);
  const Vec<Jet, 6> g = J.transpose() * r * weight;

  PairDerivatives out;
  out.rows = Metric::kDim;
  Mat<double, Metric::kDim, 6> J_value;
  for (int row = 0; row < Metric::kDim; ++row) {
    for (int i = 0; i < 6; ++i) {
      J_value(row, i) = J(row, i).a;
    }
  }
  out.gauss_newton = rho[1] * J_value.transpose() * J_value;
  for (int i = 0; i < 6; ++i) {
    const bool smooth = g[i].v.allFinite();
    out.gradient[i] = g[i].a;
    out.gradient_by_xi.row(i) =
        smooth ? g[i].v.head<6>().transpose().eval() : Vec6::Zero().transpose();
    out.by_source_range[i] = smooth ? g[i].v[kSourceRange] : 0;
    out.by_target_range[i] = smooth ? g[i].v[kTargetRange] : 0;
  }
  return out;
}

template <class Metric>
PairGradient GradientOf(const Correspondence& pair, const SE3d& T,
                        const ceres::LossFunction* loss) {
  const Metric metric = Metric::From(pair);
  const Vec<double, Metric::kDim> r = metric.Residual(T);
  const Mat<double, Metric::kDim, 6> J = metric.Jacobian(T);
  double rho[3] = {0, 1, 0};
  if (loss != nullptr) {
    loss->Evaluate(r.squaredNorm(), rho);
  }
  return {rho[1] * J.transpose() * r, rho[1] * J.transpose() * J, Metric::kDim};
}

// By the metrics' places.
template <class... Metrics>
PairDerivativesFunction DifferentiateAt(std::size_t place, MetricList<Metrics...>) {
  constexpr PairDerivativesFunction kFunctions[] = {&Differentiate<Metrics>...};
  return kFunctions[place];
}
template <class... Metrics>
PairGradientFunction GradientAt(std::size_t place, MetricList<Metrics...>) {
  constexpr PairGradientFunction kFunctions[] = {&GradientOf<Metrics>...};
  return kFunctions[place];
}

}  // namespace

PairDerivativesFunction PairDerivativesOf(const RegisteredMetric& metric) {
  return DifferentiateAt(metric.place, AllMetrics{});
}

PairGradientFunction PairGradientOf(const RegisteredMetric& metric) {
  return GradientAt(metric.place, AllMetrics{});
}

}  // namespace icpscape
