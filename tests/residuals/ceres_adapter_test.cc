// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/adapters/ceres.h"

#include <ceres/loss_function.h>
#include <ceres/manifold_test_utils.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <vector>

#include "residuals/point_to_plane.h"
#include "residuals/point_to_point.h"
#include "tests/support/residual_test_suite.h"

namespace icpscape {
namespace {

using namespace ceres;  // NOLINT: the macro below is not qualified in Ceres 2.1.

TEST(SE3Manifold, HoldsCeresInvariants) {
  const SE3Manifold manifold;
  ResidualSampler sampler(42);
  for (int i = 0; i < 1000; ++i) {
    Vector x(7), y(7), delta(6);
    sampler.Pose(3, sampler.Uniform(0, 3)).ToParameters(x.data());
    sampler.Pose(3, sampler.Uniform(0, 3)).ToParameters(y.data());
    if (x.head<4>().dot(y.head<4>()) < 0) {
      y.head<4>() = -y.head<4>();  // The same pose; Plus stays on x's side of the sphere.
    }
    delta << sampler.Uniform(0, 3) * sampler.UnitVector(), sampler.Point(2);
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
  }
}

TEST(SE3Manifold, PlusIsTheExponentialFromTheRight) {
  const SE3Manifold manifold;
  ResidualSampler sampler(1);
  for (int i = 0; i < 100; ++i) {
    const SE3d T = sampler.Pose(3, 1);
    Vec6 xi;
    xi << sampler.UnitVector(), sampler.Point(2);
    double x[7], moved[7];
    T.ToParameters(x);
    ASSERT_TRUE(manifold.Plus(x, xi.data(), moved));
    EXPECT_LE((SE3d::FromParameters(moved).Matrix() - (T * SE3d::Exp(xi)).Matrix()).norm(), 1e-13);
  }
}

TEST(SE3SubsetManifold, HoldsCeresInvariants) {
  ResidualSampler sampler(43);
  for (const DofMask& mask : {kAllDof, kPlanarDof, DofMask{false, true, false, true, false, true},
                              DofMask{false, false, false, false, false, true}}) {
    const SE3SubsetManifold manifold(mask);
    for (int i = 0; i < 250; ++i) {
      const int size = manifold.TangentSize();
      Vector x(7), y(7), delta(size), to_y(size);
      sampler.Pose(3, sampler.Uniform(0, 3)).ToParameters(x.data());
      for (int k = 0; k < size; ++k) {
        delta[k] = sampler.Uniform(-1, 1);
        to_y[k] = sampler.Uniform(-1, 1);
      }
      manifold.Plus(x.data(), to_y.data(), y.data());
      EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
    }
  }
}

TEST(SE3SubsetManifold, StepsInTheFreeDirections) {
  ResidualSampler sampler(2);
  const SE3d T = sampler.Pose(3, 1);
  double x[7], moved[7];
  T.ToParameters(x);
  const double delta[3] = {0.2, 1.5, -0.3};
  SE3SubsetManifold(kPlanarDof).Plus(x, delta, moved);
  const SE3d step = T.Inverse() * SE3d::FromParameters(moved);
  EXPECT_NEAR(step.t().z(), 0, 1e-14);
  EXPECT_LE((step.LogRotation() - Vec3(0, 0, 0.2)).norm(), 1e-14);
  // Along the arc, not the chord: the true exponential.
  EXPECT_LE((step.t() - SE3d::Exp((Vec6() << 0, 0, 0.2, 1.5, -0.3, 0).finished()).t()).norm(),
            1e-14);
}

// Sums over pairs, by the plain door.
template <class Metric>
NormalEquations SumsAt(const std::vector<Metric>& metrics, const SE3d& T,
                       const LossFunction* loss) {
  NormalEquations sums;
  for (const Metric& metric : metrics) {
    if (loss == nullptr) {
      Accumulate(metric, T, &sums);
    } else {
      const auto r = metric.Residual(T);
      double rho[3];
      loss->Evaluate(r.squaredNorm(), rho);
      sums.Add(r, metric.Jacobian(T), rho);
    }
  }
  return sums;
}

// The block must have the sums' cost, gradient and Hessian, for any rank.
template <class Metric>
void ExpectBlockEqualsSums(const std::vector<Metric>& metrics, const SE3d& T,
                           const LossFunction* loss = nullptr) {
  const NormalEquations sums = SumsAt(metrics, T, loss);
  const SquareRootCost cost([&](const SE3d& pose) { return SumsAt(metrics, pose, loss); });
  double x[7], r[7], J[49];
  T.ToParameters(x);
  const double* parameters[] = {x};
  double* jacobians[] = {J};
  ASSERT_TRUE(cost.Evaluate(parameters, r, jacobians));
  const Eigen::Map<const Vec<double, 7>> residual(r);
  SE3Manifold::PlusMatrix plus;
  SE3Manifold().PlusJacobian(x, plus.data());
  const Eigen::Matrix<double, 7, 6> tangent =
      Eigen::Map<const Eigen::Matrix<double, 7, 7, Eigen::RowMajor>>(J) * plus;
  EXPECT_NEAR(residual.squaredNorm(), 2 * sums.cost, 1e-12 * (2 * sums.cost) + 1e-30);
  EXPECT_LE((tangent.transpose() * residual - sums.gradient).norm(),
            1e-12 * (sums.gradient.norm() + std::sqrt(2 * sums.cost * sums.Hessian().norm())));
  EXPECT_LE((tangent.transpose() * tangent - sums.Hessian()).norm(), 1e-12 * sums.Hessian().norm());
  // Without Jacobians: the same residual.
  double again[7];
  ASSERT_TRUE(cost.Evaluate(parameters, again, nullptr));
  EXPECT_EQ((Eigen::Map<const Vec<double, 7>>(again) - residual).norm(), 0);
}

template <class Metric>
std::vector<Metric> RandomMetrics(int count, double distance, unsigned seed, const SE3d& T) {
  ResidualSampler sampler(seed);
  std::vector<Metric> metrics;
  for (int i = 0; i < count; ++i) {
    metrics.push_back(Metric::From(sampler.Pair(T, distance)));
  }
  return metrics;
}

TEST(SquareRootCost, EqualsTheSums) {
  ResidualSampler sampler(9);
  for (int i = 0; i < 50; ++i) {
    const SE3d T = sampler.Pose(3, 1);
    ExpectBlockEqualsSums(RandomMetrics<PointToPlane>(200, 0.5, 2, T), T);
    ExpectBlockEqualsSums(RandomMetrics<PointToPoint>(200, 0.5, 3, T), T);
  }
}

TEST(SquareRootCost, PerfectFit) {
  ExpectBlockEqualsSums(RandomMetrics<PointToPoint>(100, 0, 4, SE3d()), SE3d());
}

TEST(SquareRootCost, ThreeMatches) {
  ExpectBlockEqualsSums(RandomMetrics<PointToPlane>(3, 0.5, 5, SE3d()), SE3d());
  ExpectBlockEqualsSums(RandomMetrics<PointToPoint>(1, 0.5, 5, SE3d()), SE3d());
}

TEST(SquareRootCost, OnePlane) {
  std::vector<PointToPlane> metrics = RandomMetrics<PointToPlane>(100, 0.5, 6, SE3d());
  for (PointToPlane& metric : metrics) {
    metric.n_target = Vec3::UnitZ();
  }
  ExpectBlockEqualsSums(metrics, SE3d());
}

TEST(SquareRootCost, AllOutliersUnderTukey) {
  const TukeyLoss tukey(0.01);
  const auto metrics = RandomMetrics<PointToPoint>(100, 5, 7, SE3d());
  ASSERT_EQ(SumsAt(metrics, SE3d(), &tukey).Hessian().norm(), 0);
  ExpectBlockEqualsSums(metrics, SE3d(), &tukey);
}

TEST(SquareRootCost, RefusesWhatItCannotStandFor) {
  double x[7], r[7];
  SE3d().ToParameters(x);
  const double* parameters[] = {x};
  const SquareRootCost not_finite([](const SE3d&) {
    NormalEquations sums;
    sums.cost = std::numeric_limits<double>::quiet_NaN();
    return sums;
  });
  EXPECT_FALSE(not_finite.Evaluate(parameters, r, nullptr));
  // TolerantLoss curves upwards: Ceres' correction is not the one that the sums follow.
  const TolerantLoss tolerant(1, 0.5);
  const auto metrics = RandomMetrics<PointToPoint>(10, 0.5, 8, SE3d());
  const SquareRootCost upward([&](const SE3d& T) { return SumsAt(metrics, T, &tolerant); });
  EXPECT_FALSE(upward.Evaluate(parameters, r, nullptr));
}

TEST(SquareRootCost, CallsTheObjectiveOncePerPose) {
  int calls = 0;
  const auto metrics = RandomMetrics<PointToPoint>(10, 0.5, 8, SE3d());
  const SquareRootCost cost([&](const SE3d& T) {
    ++calls;
    return SumsAt(metrics, T, nullptr);
  });
  double x[7], r[7], J[49];
  SE3d().ToParameters(x);
  const double* parameters[] = {x};
  double* jacobians[] = {J};
  cost.Evaluate(parameters, r, nullptr);
  cost.Evaluate(parameters, r, jacobians);
  EXPECT_EQ(calls, 1);
  x[4] = 1;
  cost.Evaluate(parameters, r, jacobians);
  EXPECT_EQ(calls, 2);
}

// The same trust-region iterates as with one residual block per pair, for every loss.
class SameIterates : public testing::TestWithParam<std::shared_ptr<LossFunction>> {};

std::vector<double> Solve(Problem* problem, double* x, const Solver::Options& options) {
  problem->SetManifold(x, new SE3Manifold);
  Solver::Summary summary;
  ceres::Solve(options, problem, &summary);
  std::vector<double> costs;
  for (const IterationSummary& iteration : summary.iterations) {
    costs.push_back(iteration.cost);
  }
  return costs;
}

TEST_P(SameIterates, AsOneBlockPerPair) {
  const SE3d truth = SE3d::Exp((Vec6() << 0.02, -0.01, 0.05, 0.5, 0.1, -0.1).finished());
  std::vector<PointToPlane> metrics = RandomMetrics<PointToPlane>(500, 0.05, 10, truth);
  for (std::size_t i = 0; i < metrics.size(); i += 10) {
    metrics[i].q_target += Vec3(0.5, 0.3, 0.4);  // Outliers, so that the losses bite.
  }
  LossFunction* loss = GetParam().get();
  Problem::Options borrowed;
  borrowed.loss_function_ownership = DO_NOT_TAKE_OWNERSHIP;
  Solver::Options options;
  options.linear_solver_type = DENSE_QR;
  options.logging_type = SILENT;
  options.max_num_iterations = 8;

  double x_blocks[7], x_root[7];
  SE3d().ToParameters(x_blocks);
  SE3d().ToParameters(x_root);
  Problem blocks(borrowed);
  for (const PointToPlane& metric : metrics) {
    blocks.AddResidualBlock(new CeresCost<PointToPlane>(metric), loss, x_blocks);
  }
  Problem root(borrowed);
  root.AddResidualBlock(new SquareRootCost([&](const SE3d& T) { return SumsAt(metrics, T, loss); }),
                        nullptr, x_root);
  const std::vector<double> costs_blocks = Solve(&blocks, x_blocks, options);
  const std::vector<double> costs_root = Solve(&root, x_root, options);
  ASSERT_EQ(costs_blocks.size(), costs_root.size());
  ASSERT_GE(costs_blocks.size(), 3U);
  for (std::size_t i = 0; i < costs_blocks.size(); ++i) {
    EXPECT_NEAR(costs_blocks[i], costs_root[i], 1e-12 * costs_blocks[i]);
  }
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(x_blocks[i], x_root[i], 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(Losses, SameIterates,
                         testing::Values(nullptr, std::make_shared<HuberLoss>(0.1),
                                         std::make_shared<SoftLOneLoss>(0.1),
                                         std::make_shared<CauchyLoss>(0.1),
                                         std::make_shared<ArctanLoss>(0.01),
                                         std::make_shared<TukeyLoss>(0.7)));

}  // namespace
}  // namespace icpscape
