// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/pair_derivatives.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include "icpscape/residuals/registry.h"
#include "icpscape/testing/residual_sampler.h"

namespace icpscape {
namespace {

// Cost and gradient of one pair, written as the documentation has them.
template <class Metric>
double Cost(const Correspondence& pair, const SE3d& T, const ceres::LossFunction& loss) {
  double rho[3];
  loss.Evaluate(Metric::From(pair).Residual(T).squaredNorm(), rho);
  return 0.5 * rho[0];
}
template <class Metric>
Vec6 Gradient(const Correspondence& pair, const SE3d& T, const ceres::LossFunction& loss) {
  const Metric metric = Metric::From(pair);
  const auto r = metric.Residual(T);
  double rho[3];
  loss.Evaluate(r.squaredNorm(), rho);
  return rho[1] * metric.Jacobian(T).transpose() * r;
}

const Sensors kSensors = {Vec3(3, -2, 1), Vec3(-5, 4, 2)};

// The pair with its points moved along the rays from their sensors.
Correspondence Moved(const Correspondence& pair, double source_m, double target_m) {
  Correspondence moved = pair;
  moved.p_source += source_m * (pair.p_source - kSensors.source).normalized();
  const Vec3 step = target_m * (pair.q_target - kSensors.target).normalized();
  moved.q_target += step;
  moved.a_line += step;
  moved.q_patch += step;
  return moved;
}

template <class M>
void CheckAgainstDifferences() {
  ResidualSampler sampler(3);
  const ceres::CauchyLoss loss(0.7);
  constexpr double h = 1e-4;
  for (int sample = 0; sample < 20; ++sample) {
    SCOPED_TRACE(std::string(M::kName) + ", sample " + std::to_string(sample));
    const SE3d T = sampler.Pose(3, sampler.Uniform(0, 2));
    const Correspondence pair = sampler.Pair(T, 0.5);
    const PairDerivatives d = PairDerivativesOf(MetricNamed(M::kName))(pair, T, &loss, kSensors);
    EXPECT_EQ(d.rows, M::kDim);
    const Vec6 gradient = Gradient<M>(pair, T, loss);
    EXPECT_LE((d.gradient - gradient).norm(), 1e-12 * gradient.norm());
    // Fourth-order differences: the exact Hessian of the cost through Exp, one row after the other.
    Mat6 hessian;
    const auto cost = [&](const Vec6& xi) { return Cost<M>(pair, T * SE3d::Exp(xi), loss); };
    const auto slope = [&](const Vec6& at, const Vec6& along) {
      return (8 * (cost(at + along) - cost(at - along)) -
              (cost(at + 2 * along) - cost(at - 2 * along))) /
             (12 * h);
    };
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        const Vec6 a = h * Vec6::Unit(i);
        const Vec6 b = h * Vec6::Unit(j);
        hessian(i, j) =
            (8 * (slope(a, b) - slope(-a, b)) - (slope(2 * a, b) - slope(-2 * a, b))) / (12 * h);
      }
    }
    const Mat6 symmetric = 0.5 * (d.gradient_by_xi + d.gradient_by_xi.transpose());
    EXPECT_LE((symmetric - hessian).norm(), 1e-4 * hessian.norm()) << symmetric << "\n\n"
                                                                   << hessian;
    const auto by_range = [&](double source, double target) {
      return ((Gradient<M>(Moved(pair, h * source, h * target), T, loss) -
               Gradient<M>(Moved(pair, -h * source, -h * target), T, loss)) /
              (2 * h))
          .eval();
    };
    EXPECT_LE((d.by_source_range - by_range(1, 0)).norm(), 1e-5 * (1 + by_range(1, 0).norm()));
    EXPECT_LE((d.by_target_range - by_range(0, 1)).norm(), 1e-5 * (1 + by_range(0, 1).norm()));
  }
}

TEST(PairDerivatives, AreThoseOfEveryMetric) {
  ForEachMetric([](auto tag) { CheckAgainstDifferences<typename decltype(tag)::Metric>(); });
}

TEST(PairDerivatives, WithoutLossTheGaussNewtonPartIsJtJ) {
  ResidualSampler sampler(4);
  const SE3d T = sampler.Pose(3, 1);
  const Correspondence pair = sampler.Pair(T, 0.5);
  const auto J = TwoPlane::From(pair).Jacobian(T);
  const PairDerivatives d = PairDerivativesOf(MetricNamed("two_plane"))(pair, T, nullptr, {});
  EXPECT_LE((d.gauss_newton - J.transpose() * J).norm(), 1e-12 * d.gauss_newton.norm());
}

// On the line the distance has no derivative: nothing may become NaN.
TEST(PairDerivatives, AreFiniteWhereTheMetricIsNotSmooth) {
  ResidualSampler sampler(5);
  const SE3d T = sampler.Pose(3, 1);
  Correspondence pair = sampler.Pair(T, 0);
  pair.a_line = T * pair.p_source;
  const PairDerivatives d =
      PairDerivativesOf(MetricNamed("edge_to_line_distance"))(pair, T, nullptr, {});
  EXPECT_TRUE(d.gradient.allFinite());
  EXPECT_TRUE(d.gradient_by_xi.allFinite());
  EXPECT_TRUE(d.by_source_range.allFinite());
  EXPECT_TRUE(d.by_target_range.allFinite());
}

}  // namespace
}  // namespace icpscape
