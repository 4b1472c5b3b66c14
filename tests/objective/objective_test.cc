// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/objective.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/sequences.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/objective/loss.h"
#include "icpscape/objective/pairs.h"
#include "icpscape/residuals/adapters/ceres.h"
#include "icpscape/residuals/registry.h"
#include "icpscape/testing/residual_sampler.h"
#include "tests/support/matchers.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::HasSubstr;

std::vector<std::string> AllMetricNames() {
  std::vector<std::string> names;
  ForEachMetric([&](auto tag) { names.emplace_back(decltype(tag)::Metric::kName); });
  return names;
}

struct RoomPair {
  PointCloud source = testing_support::Room(1500, 1, SE3d(), 0.01);
  PointCloud target = testing_support::Room(1500, 2, SE3d(), 0.01);
  RoomPair() {
    testing_support::Complete(&source);
    testing_support::Complete(&target);
  }
};

const RoomPair& Room() {
  static const RoomPair pair;
  return pair;
}

struct CeresAnswer {
  double cost = 0;
  Vec6 gradient = Vec6::Zero();
};

CeresAnswer EvaluateProblem(ceres::Problem* problem, double* x) {
  CeresAnswer answer;
  std::vector<double> gradient;
  problem->SetManifold(x, new SE3Manifold);
  EXPECT_TRUE(problem->Evaluate({}, &answer.cost, nullptr, &gradient, nullptr));
  answer.gradient = Eigen::Map<const Vec6>(gradient.data());
  return answer;
}

// Every metric with every loss.
class EqualsCeres : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(EqualsCeres, OnFrozenMatches) {
  const auto& [metric, loss_name] = GetParam();
  const auto loss = MakeLoss(loss_name, 0.1);
  const auto matcher = testing_support::MatcherFor(metric, Room().source, Room().target);
  const Objective objective(metric, *matcher, loss);
  ResidualSampler sampler(42);
  ceres::Problem::Options borrowed;
  borrowed.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  double x[7];
  const Matches matches = objective.Match(SE3d(), 1);
  SE3d().ToParameters(x);
  ceres::Problem blocks(borrowed);
  objective.AddResidualBlocks(matches, objective.loss(), x, &blocks);
  double size = 0;  // sum |J_i^T r_i|: what a gradient of cancelling terms can be compared with.
  for (int i = 0; i < 100; ++i) {
    sampler.Pose(0.5, 0.2).ToParameters(x);
    const SE3d T = SE3d::FromParameters(x);
    const Evaluation ours = objective.Evaluate(T, matches, 1);
    const CeresAnswer per_pair = EvaluateProblem(&blocks, x);
    EXPECT_NEAR(ours.sums.cost, per_pair.cost, 1e-12 * per_pair.cost);
    size = 0;
    // By hand from the clouds, so that what the objective hands to the metric is checked too.
    double cost = 0;
    Vec6 gradient = Vec6::Zero();
    for (std::size_t p = 0; p < Room().source.size(); ++p) {
      WithMetric(metric, [&](auto tag) {
        if (matches.target_index[p] < 0) {
          return;
        }
        const auto m =
            decltype(tag)::Metric::From(testing_support::PairByHand(*matcher, matches, p));
        const Vec6 term = m.Jacobian(T).transpose() * m.Residual(T);
        double rho[3] = {m.Residual(T).squaredNorm(), 1, 0};
        if (objective.loss() != nullptr) {
          objective.loss()->Evaluate(rho[0], rho);
        }
        size += term.norm();
        cost += 0.5 * rho[0];
        gradient += rho[1] * term;
      });
    }
    EXPECT_LE((ours.sums.gradient - per_pair.gradient).norm(), 1e-12 * size);
    EXPECT_NEAR(ours.sums.cost, cost, 1e-12 * cost);
    EXPECT_LE((ours.sums.gradient - gradient).norm(), 1e-12 * size);
    if (loss_name != "tolerant") {
      ceres::Problem root;
      root.AddResidualBlock(new SquareRootCost([&](const SE3d& pose) {
                              return objective.Evaluate(pose, matches, 1).sums;
                            }),
                            nullptr, x);
      const CeresAnswer square_root = EvaluateProblem(&root, x);
      EXPECT_NEAR(square_root.cost, per_pair.cost, 1e-12 * per_pair.cost);
      EXPECT_LE((square_root.gradient - per_pair.gradient).norm(), 1e-12 * size);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(MetricsAndLosses, EqualsCeres,
                         testing::Combine(testing::ValuesIn(AllMetricNames()),
                                          testing::ValuesIn(LossNames())),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" + std::get<1>(test.param);
                         });

TEST(Objective, ThreePairsByHand) {
  PointCloud source, target;
  for (const double x : {1.0, 2.0, 3.0}) {
    testing_support::AddPoint({x, 0, 0}, &source);
    testing_support::AddPoint({x, 0.3, 0}, &target);
  }
  const ClosestPointMatcher matcher(source, target);
  const Objective objective("point_to_point", matcher);
  // At the identity every point is 0.3 below its match; moved by +0.1 in y, 0.2.
  const SE3d T(Mat3::Identity(), Vec3(0, 0.1, 0));
  const Evaluation evaluation = objective.Evaluate(T, 1);
  EXPECT_EQ(evaluation.n(), 3);
  EXPECT_NEAR(evaluation.epsilon, 3 * 0.04, 1e-7);
  EXPECT_NEAR(evaluation.sums.cost, 1.5 * 0.04, 1e-7);
  EXPECT_NEAR(evaluation.Rmse(), 0.2, 1e-7);
  EXPECT_NEAR(evaluation.RmsResidual(), 0.2, 1e-7);
  // d cost / d v_y = sum r_y = -0.6; about z: sum r_y x = -0.2 (1 + 2 + 3).
  EXPECT_NEAR(evaluation.sums.gradient[4], -0.6, 1e-7);
  EXPECT_NEAR(evaluation.sums.gradient[2], -1.2, 1e-7);
  EXPECT_NEAR(evaluation.sums.Hessian()(4, 4), 3, 1e-12);
  EXPECT_NEAR(evaluation.sums.Hessian()(2, 2), 1 + 4 + 9, 1e-12);
  // Going up in y by 1 per unit of u lowers the distance by as much.
  EXPECT_NEAR(evaluation.RmseSlope((Vec6() << 0, 0, 0, 0, 1, 0).finished()), -1, 1e-6);
}

// The paper's RMSE knows no loss; the cost does.
TEST(Objective, LossBendsTheCostButNotTheRmse) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective plain("point_to_plane", matcher);
  const Objective robust("point_to_plane", matcher, MakeLoss("huber", 0.005));
  const SE3d T(Mat3::Identity(), Vec3(0.1, 0.05, 0));
  const Matches matches = plain.Match(T, 1);
  const Evaluation a = plain.Evaluate(T, matches, 1);
  const Evaluation b = robust.Evaluate(T, matches, 1);
  EXPECT_LT(b.sums.cost, 0.9 * a.sums.cost);
  EXPECT_NEAR(b.Rmse(), a.Rmse(), 1e-12);
  EXPECT_NEAR(b.RmsResidual(), a.RmsResidual(), 1e-12);
  EXPECT_LE((b.epsilon_gradient - a.epsilon_gradient).norm(), 1e-10 * a.epsilon_gradient.norm());
}

TEST(Objective, KnowsWhichLossesCurveUpwards) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  for (const std::string& loss : LossNames()) {
    for (const double scale : {1e-3, 0.1, 10.0}) {
      EXPECT_EQ(Objective("point_to_plane", matcher, MakeLoss(loss, scale)).HasUpwardLoss(),
                loss == "tolerant");
    }
  }
}

// Curves upwards only between s and 1.04 s, and only a little.
class UpwardBand final : public ceres::LossFunction {
 public:
  explicit UpwardBand(double low) : low_(low) {}
  void Evaluate(double s, double rho[3]) const override {
    rho[0] = s, rho[1] = 1, rho[2] = s >= low_ && s <= 1.04 * low_ ? 1e-15 : -1;
  }

 private:
  double low_;
};

// Between the ends of the documented range no band of that width is missed, beyond them any.
TEST(Objective, LooksForUpwardLossesFrom1em12To1e12) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const auto found = [&](double low) {
    return Objective("point_to_plane", matcher, std::make_shared<UpwardBand>(low)).HasUpwardLoss();
  };
  for (const double low : {1e-12, 3.3e-11, 0.7, 1.0, 5e4, 9.7e11}) {
    EXPECT_TRUE(found(low)) << low;
  }
  EXPECT_FALSE(found(0.9e-12));
  EXPECT_FALSE(found(1.1e12));
}

TEST(Objective, ReassociatedIsFrozenWithItsOwnMatches) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  const SE3d T(Mat3::Identity(), Vec3(0.2, 0.1, 0));
  const Evaluation a = objective.Evaluate(T, 1);
  const Evaluation b = objective.Evaluate(T, objective.Match(T, 1), 1);
  EXPECT_EQ(a.sums.cost, b.sums.cost);
  // The nearest pairs of a pose are the best pairs at that pose, for point-to-point.
  const Objective distance("point_to_point", matcher);
  EXPECT_LT(distance.Evaluate(T, 1).sums.cost,
            distance.Evaluate(T, distance.Match(SE3d(), 1), 1).sums.cost);
}

TEST(Objective, IsBitIdenticalForAnyNumberOfThreads) {
  PointCloud source = testing_support::Room(20000, 3, SE3d(), 0.01);
  PointCloud target = testing_support::Room(20000, 4, SE3d(), 0.01);
  testing_support::Complete(&source);
  testing_support::Complete(&target);
  for (const std::string& metric : AllMetricNames()) {
    const auto matcher = testing_support::MatcherFor(metric, source, target);
    const Objective objective(metric, *matcher);
    const Evaluation one = objective.Evaluate(SE3d(), 1);
    for (const int threads : {2, 3, 4}) {
      const Evaluation many = objective.Evaluate(SE3d(), threads);
      EXPECT_EQ(one.sums.cost, many.sums.cost);
      EXPECT_EQ(one.sums.gradient, many.sums.gradient);
      EXPECT_EQ(one.sums.hessian, many.sums.hessian);
    }
  }
}

TEST(Objective, GateAndMissingNormalsReduceN) {
  PointCloud source, target;
  for (const double x : {1.0, 2.0, 30.0}) {
    testing_support::AddPoint({x, 0, 0}, &source);
  }
  testing_support::AddPoint({1, 0, 0.1}, &target);
  testing_support::AddPoint({2, 0, 0.1}, &target);
  target.nx = {0, 0};
  target.ny = {0, 0};
  target.nz = {1, 0};  // The second has no normal.
  const ClosestPointMatcher gated(source, target, {0.5});
  EXPECT_EQ(Objective("point_to_point", gated).Evaluate(SE3d(), 1).n(), 2);
  EXPECT_EQ(Objective("point_to_plane", gated).Evaluate(SE3d(), 1).n(), 1);
  const ClosestPointMatcher open(source, target);
  EXPECT_EQ(Objective("point_to_point", open).Evaluate(SE3d(), 1).n(), 3);
}

// Every number of every pair, with the pose of the matches, not the one of an evaluation.
TEST(Objective, HandsOutPairsAsTheCloudsHaveThem) {
  for (const char* metric : {"two_plane", "edge_to_line", "planar_to_patch"}) {
    const auto matcher = testing_support::MatcherFor(metric, Room().source, Room().target);
    const Objective objective(metric, *matcher);
    const SE3d T = SE3d::Exp((Vec6() << 0.01, -0.02, 0.03, 0.1, 0.2, 0).finished());
    const Matches matches = objective.Match(T, 1);
    int pairs = 0;
    ForEachPair(objective, matches, [&](std::size_t i, std::size_t j, const Correspondence& pair) {
      EXPECT_EQ(matches.target_index[i], static_cast<std::int32_t>(j));
      const Correspondence expected = testing_support::PairByHand(*matcher, matches, i);
      ForEachQuantity<double>([&](auto row) {
        using Row = decltype(row);
        if (Row::IsNeededBy(objective.needs())) {
          EXPECT_EQ(pair.*Row::kMember, expected.*Row::kMember) << metric << " " << i;
        }
      });
      EXPECT_EQ(pair.R_matched, T.R());
      ++pairs;
    });
    EXPECT_EQ(pairs, objective.Evaluate(SE3d(), matches, 1).n());
    EXPECT_GT(pairs, 100);
  }
}

TEST(Objective, WhatAMetricDoesNotNeedMayBeMissing) {
  const ClosestPointMatcher target_only(testing_support::Room(100, 1), Room().target);
  EXPECT_EQ(Objective("point_to_plane", target_only).Evaluate(SE3d(), 1).n(), 100);
}

TEST(Objective, UnknownMetricNamesTheKnownOnes) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  try {
    const Objective objective("point_to_pint", matcher);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("point_to_pint"));
    EXPECT_THAT(error.what(), HasSubstr("point_to_plane, symmetric"));
  }
}

TEST(Objective, HoldsTheOneEntryOfItsMetric) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("symmetric", matcher);
  EXPECT_EQ(&objective.metric(), &MetricNamed("symmetric"));
  EXPECT_EQ(objective.metric().name, "symmetric");
  EXPECT_EQ(objective.metric().needs, kSourceNormal | kTargetNormal);
  EXPECT_NE(&objective.metric(), &MetricNamed("symmetric_split"));
}

// The environment is asked when an objective is made, not for every block of pairs.
TEST(Objective, RunsAtTheSimdLevelThatItWasMadeAt) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  const Matches matches = objective.Match(SE3d(), 1);
  const double cost = objective.Evaluate(SE3d(), matches, 1).sums.cost;
  setenv("ICPSCAPE_SIMD", "of another machine", 1);
  EXPECT_THROW(Objective("point_to_plane", matcher), UsageError);
  EXPECT_EQ(objective.Evaluate(SE3d(), matches, 1).sums.cost, cost);
  unsetenv("ICPSCAPE_SIMD");
}

// The data's independent implementation (numpy and scipy; all points, exact neighbours, normals
// from 20 neighbours) at the ground truth of 00/95 and 00/15, to the three digits that it states.
TEST(Objective, AgreesWithAnIndependentImplementationOnRealScans) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::filesystem::path root = KittiRoot();
  struct {
    int frame;
    double point_to_point, point_to_plane, symmetric;
  } const expected[] = {{95, 0.143, 0.062, 0.085}, {15, 0.232, 0.108, 0.152}};
  for (const auto& e : expected) {
    ScanPair pair = OpenKittiSequence(root, "00").Pair(e.frame, e.frame - 1);
    EstimateNormals({}, 2, &pair.source);
    EstimateNormals({}, 2, &pair.target);
    const ClosestPointMatcher matcher(pair.source, pair.target);
    const SE3d truth = *pair.T_ground_truth;
    const auto rmse = [&](const char* metric) {
      return Objective(metric, matcher).Evaluate(truth, 2).Rmse();
    };
    EXPECT_NEAR(rmse("point_to_point"), e.point_to_point, 5e-4);
    EXPECT_NEAR(rmse("point_to_plane"), e.point_to_plane, 5e-4);
    EXPECT_NEAR(rmse("symmetric"), e.symmetric, 5e-4);
  }
}

}  // namespace
}  // namespace icpscape
