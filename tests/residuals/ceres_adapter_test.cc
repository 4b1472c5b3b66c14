// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/adapters/ceres.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "icpscape/residuals/point_to_plane.h"
#include "icpscape/residuals/point_to_point.h"
#include "icpscape/testing/residual_test_suite.h"
#include "tests/support/named.h"

namespace icpscape {
namespace {

using namespace ceres;  // NOLINT: the tests below are about its losses and problems.

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

// A patch of a few centimetres seen from 100 m: a turn and a slide nearly look alike, and the
// direction in which they differ, with an eigenvalue of some 1e-7 of the largest, still counts.
TEST(SquareRootCost, OneSmallPatchFarAway) {
  ResidualSampler sampler(11);
  std::vector<PointToPoint> metrics;
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = Vec3(100, 20, 0) + sampler.Point(0.03);
    metrics.push_back({p, p + sampler.Point(0.01)});
  }
  const Mat6 H = SumsAt(metrics, SE3d(), nullptr).Hessian();
  const Vec6 scale = H.diagonal().cwiseSqrt().cwiseInverse();
  const Vec6 lambda =
      Eigen::SelfAdjointEigenSolver<Mat6>(scale.asDiagonal() * H * scale.asDiagonal())
          .eigenvalues();
  ASSERT_LT(lambda[0], 1e-6 * lambda[5]);
  ASSERT_GT(lambda[0], 1e-9 * lambda[5]);
  ExpectBlockEqualsSums(metrics, SE3d());
}

// Directions are weighed after scaling: units of the parameters decide nothing, and one in which
// nothing but rounding has weight is left out, whatever its gradient.
TEST(SquareRootCost, LeavesOutWhatOnlyRoundingWeighs) {
  NormalEquations sums;
  sums.hessian = Mat6::Identity();
  sums.hessian(0, 1) = 1 - 1e-14;  // Eigenvalues 2 - 1e-14 and 1e-14.
  sums.hessian(5, 5) = 1e-16;
  sums.gradient << 1e-3, -1e-3, 0, 0, 0, 2e-9;
  sums.cost = 1;
  const SquareRootCost cost([&](const SE3d&) { return sums; });
  double x[7], r[7], J[49];
  SE3d().ToParameters(x);
  const double* parameters[] = {x};
  double* jacobians[] = {J};
  ASSERT_TRUE(cost.Evaluate(parameters, r, jacobians));
  SE3Manifold::PlusMatrix plus;
  SE3Manifold().PlusJacobian(x, plus.data());
  const Eigen::Matrix<double, 7, 6> tangent =
      Eigen::Map<const Eigen::Matrix<double, 7, 7, Eigen::RowMajor>>(J) * plus;
  const Eigen::Map<const Vec<double, 7>> residual(r);
  EXPECT_NEAR(residual.squaredNorm(), 2, 1e-12);
  EXPECT_NEAR((tangent.transpose() * tangent)(5, 5), 1e-16, 1e-28);
  EXPECT_NEAR((tangent.transpose() * residual)[5], 2e-9, 1e-20);
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
  const SquareRootCost no_gradient([](const SE3d&) {
    NormalEquations sums;
    sums.gradient[2] = std::numeric_limits<double>::quiet_NaN();
    return sums;
  });
  EXPECT_FALSE(no_gradient.Evaluate(parameters, r, nullptr));
  const SquareRootCost no_hessian([](const SE3d&) {
    NormalEquations sums;
    sums.hessian(1, 2) = std::numeric_limits<double>::infinity();
    return sums;
  });
  EXPECT_FALSE(no_hessian.Evaluate(parameters, r, nullptr));
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
  for (int i = 0; i < 7; ++i) {
    x[i] += 0.25;  // Whichever of the seven it is.
    cost.Evaluate(parameters, r, jacobians);
    EXPECT_EQ(calls, 2 + i);
  }
}

// The same trust-region iterates as with one residual block per pair, for every loss.
using NamedLoss = testing_support::Named<std::shared_ptr<LossFunction>>;

class SameIterates : public testing::TestWithParam<NamedLoss> {};

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
  LossFunction* loss = GetParam().value.get();
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
                         testing::Values(NamedLoss{"none", nullptr},
                                         NamedLoss{"huber", std::make_shared<HuberLoss>(0.1)},
                                         NamedLoss{"soft_l_one",
                                                   std::make_shared<SoftLOneLoss>(0.1)},
                                         NamedLoss{"cauchy", std::make_shared<CauchyLoss>(0.1)},
                                         NamedLoss{"arctan", std::make_shared<ArctanLoss>(0.01)},
                                         NamedLoss{"tukey", std::make_shared<TukeyLoss>(0.7)}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace icpscape
