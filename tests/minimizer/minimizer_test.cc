// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/minimizer.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "icpscape/cloud/normals.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/sequences.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/objective/loss.h"
#include "icpscape/residuals/registry.h"
#include "tests/support/matchers.h"
#include "tests/support/message_of.h"
#include "tests/support/named.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.3, 0.05, -0.02).finished());

const testing_support::MovedRoom& Room() {
  static const testing_support::MovedRoom room(8000, kMotion);
  return room;
}

double DistanceM(const SE3d& a, const SE3d& b) { return (a.Inverse() * b).t().norm(); }
double AngleRad(const SE3d& a, const SE3d& b) { return (a.Inverse() * b).LogRotation().norm(); }

class BothModes : public testing::TestWithParam<testing_support::Named<Reassociation>> {
 protected:
  static MinimizerOptions Options() {
    MinimizerOptions options;
    options.reassociation = GetParam().value;
    options.threads = 2;
    return options;
  }
};

TEST_P(BothModes, FindsTheMotionWithEveryMetric) {
  ForEachMetric([&](auto tag) {
    const std::string metric = decltype(tag)::Metric::kName;
    const auto matcher = testing_support::MatcherFor(metric, Room().source, Room().target);
    const Objective objective(metric, *matcher);
    MinimizerOptions options = Options();
    options.max_iterations = 200;
    const MinimizerSummary summary = Minimize(objective, SE3d(), options);
    ASSERT_TRUE(summary.Usable()) << metric << ": " << summary.message;
    // Where the residual measures along the surface too, the sampling drags; the planes do not.
    const bool sampled =
        metric == "point_to_point" || metric == "planar_to_patch" || metric.rfind("edge", 0) == 0;
    const double limit_m = sampled ? 0.1 : 0.01;
    EXPECT_LT(DistanceM(kMotion, summary.T_target_source()), limit_m) << metric;
    EXPECT_LT(AngleRad(kMotion, summary.T_target_source()), limit_m / 5) << metric;
  });
}

// What is reported is the re-associated objective at the final pose, bit for bit.
TEST_P(BothModes, ReportsTheReassociatedCostOfTheFinalPose) {
  const ClosestPointMatcher matcher(Room().source, Room().target, {1.0});
  for (const char* loss : {"none", "huber", "tukey"}) {
    const Objective objective("point_to_plane", matcher, MakeLoss(loss, 0.05));
    const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
    ASSERT_TRUE(summary.Usable()) << loss;
    for (const Iterate& iterate : summary.iterates) {
      const Evaluation evaluation = objective.Evaluate(iterate.T_target_source, 1);
      EXPECT_EQ(iterate.cost, evaluation.sums.cost);
      EXPECT_EQ(iterate.n, evaluation.n());
    }
    EXPECT_EQ(summary.final_cost(), summary.iterates.back().cost);
  }
}

TEST_P(BothModes, RecordsStepsAndPasses) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
  ASSERT_GT(summary.iterates.size(), 2U);
  EXPECT_EQ(summary.iterates[0].T_target_source.Matrix(), SE3d().Matrix());
  EXPECT_EQ(summary.iterates[0].step_m, 0);
  for (std::size_t i = 1; i < summary.iterates.size(); ++i) {
    EXPECT_NEAR(
        summary.iterates[i].step_m,
        DistanceM(summary.iterates[i - 1].T_target_source, summary.iterates[i].T_target_source),
        1e-15);
    EXPECT_NEAR(
        summary.iterates[i].step_rad,
        AngleRad(summary.iterates[i - 1].T_target_source, summary.iterates[i].T_target_source),
        1e-15);
    EXPECT_GE(summary.iterates[i].time_s, summary.iterates[i - 1].time_s);
  }
  EXPECT_GE(summary.matching_passes, static_cast<int>(summary.iterates.size()));
}

// Eigenvalues by another algorithm: the general solver, which does not know that H is symmetric.
TEST_P(BothModes, RecordsTheEigenvaluesOfTheFreeDirections) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  for (const DofMask& mask : {kAllDof, kPlanarDof}) {
    MinimizerOptions options = Options();
    options.free = mask;
    const Iterate last = Minimize(objective, SE3d(), options).iterates.back();
    Mat6 H = objective.Evaluate(last.T_target_source, 1).sums.Hessian();
    H.topRows<3>() /= 10;
    H.leftCols<3>() /= 10;
    const Eigen::VectorXd eigenvalues =
        mask == kAllDof ? Eigen::MatrixXd(H).eigenvalues().real().eval()
                        : Eigen::MatrixXd(H.block<3, 3>(2, 2)).eigenvalues().real().eval();
    EXPECT_NEAR(last.smallest_eigenvalue, eigenvalues.minCoeff(), 1e-9 * eigenvalues.maxCoeff());
    EXPECT_NEAR(last.largest_eigenvalue, eigenvalues.maxCoeff(), 1e-9 * eigenvalues.maxCoeff());
    EXPECT_GT(last.smallest_eigenvalue, 0);
  }
}

// A car stays on the ground, and settles where no direction that it has lowers the cost; the room's
// motion has some height and tilt, towards which it would go if it could.
TEST_P(BothModes, MovesInTheFreeDirectionsAlone) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const auto settles_in_the_plane = [&](const char* loss) {
    const Objective objective("point_to_plane", matcher, MakeLoss(loss, 0.05));
    MinimizerOptions options = Options();
    options.free = kPlanarDof;
    const MinimizerSummary summary = Minimize(objective, SE3d(), options);
    ASSERT_TRUE(summary.Usable()) << summary.message;
    for (const Iterate& iterate : summary.iterates) {
      EXPECT_NEAR(iterate.T_target_source.t().z(), 0, 1e-12);
      EXPECT_NEAR(iterate.T_target_source.LogRotation().head<2>().norm(), 0, 1e-12);
    }
    const Vec6 gradient = objective.Evaluate(summary.T_target_source(), 1).sums.gradient;
    EXPECT_LT(gradient.segment<3>(2).norm(), 0.05 * gradient.norm()) << loss;
    EXPECT_LT((summary.T_target_source().t() - kMotion.t()).head<2>().norm(), 0.03) << loss;
  };
  settles_in_the_plane("none");
  if (GetParam().value == Reassociation::kEveryStep) {
    settles_in_the_plane("tolerant");  // One residual block per pair: the same manifold.
  }
}

TEST_P(BothModes, NeedsAFreeDirection) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  MinimizerOptions options = Options();
  options.free = {};
  const Objective objective("point_to_plane", matcher);
  EXPECT_EQ(testing_support::MessageOf<UsageError>([&] { Minimize(objective, SE3d(), options); }),
            "No direction is free; expected at least one.");
}

TEST_P(BothModes, ShowsEveryIterateToTheObserver) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  MinimizerOptions options = Options();
  std::vector<double> costs;
  options.observer = [&](const Observation& seen) {
    costs.push_back(seen.iterate.cost);
    // The pairs are those that the values are sums over.
    const Evaluation again =
        objective.Evaluate(seen.iterate.T_target_source, seen.matches.at(&matcher), 1);
    EXPECT_EQ(again.sums.cost, seen.iterate.cost);
    EXPECT_EQ(again.sums.gradient, seen.evaluation.sums.gradient);
    return true;
  };
  const MinimizerSummary observed = Minimize(objective, SE3d(), options);
  ASSERT_GE(costs.size(), observed.iterates.size());
  for (std::size_t i = 0; i < observed.iterates.size(); ++i) {
    EXPECT_EQ(costs[i], observed.iterates[i].cost);
  }
  EXPECT_EQ(observed.final_cost(), Minimize(objective, SE3d(), Options()).final_cost());

  int seen = 0;
  options.observer = [&](const Observation&) { return ++seen < 3; };
  const MinimizerSummary stopped = Minimize(objective, SE3d(), options);
  EXPECT_EQ(stopped.termination, Termination::kStopped);
  EXPECT_TRUE(stopped.Usable());
  EXPECT_EQ(seen, 3);
  EXPECT_LE(stopped.iterates.size(), 3U);
}

TEST_P(BothModes, StopsByTheCost) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_point", matcher);
  const std::vector<Iterate> whole = Minimize(objective, SE3d(), Options()).iterates;
  ASSERT_GT(whole.size(), 3U);

  MinimizerOptions options = Options();
  options.max_final_cost = 0.5 * (whole[0].cost + whole[1].cost);
  const MinimizerSummary reached = Minimize(objective, SE3d(), options);
  EXPECT_EQ(reached.termination, Termination::kCostReached);
  EXPECT_EQ(reached.iterates.size(), 2U);
  EXPECT_LE(reached.final_cost(), options.max_final_cost);

  options = Options();
  options.min_cost_change = 0.1;
  const MinimizerSummary hardly = Minimize(objective, SE3d(), options);
  EXPECT_EQ(hardly.termination, Termination::kCostChange);
  std::size_t expected = 1;  // The first iterate that is within a tenth of the cost before it.
  while (std::abs(whole[expected].cost - whole[expected - 1].cost) >=
         0.1 * whole[expected - 1].cost) {
    ++expected;
  }
  EXPECT_LT(expected, whole.size() - 1);
  EXPECT_EQ(hardly.iterates.size(), expected + 1);
}

// Gauss-Newton as one writes it by hand, on the same objective: as many matching passes, and the
// same pose up to the step that neither takes.
TEST(Minimizer, NeedsNoMoreMatchingPassesThanGaussNewtonByHand) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  for (const char* metric : {"point_to_plane", "symmetric"}) {
    const Objective objective(metric, matcher);
    const MinimizerOptions options;
    SE3d T;
    int passes = 0;
    for (;;) {
      const Evaluation evaluation = objective.Evaluate(T, 1);
      ++passes;
      const SE3d step =
          SE3d::Exp(-evaluation.sums.Hessian().ldlt().solve(evaluation.sums.gradient));
      if (step.t().norm() < options.min_step_m &&
          step.LogRotation().norm() < options.min_step_rad) {
        break;
      }
      T = T * step;
    }
    const MinimizerSummary summary = Minimize(objective, SE3d(), options);
    EXPECT_EQ(summary.termination, Termination::kConverged);
    EXPECT_LE(summary.matching_passes, passes) << metric;
    EXPECT_LT(DistanceM(T, summary.T_target_source()), options.min_step_m);
  }
}

TEST_P(BothModes, StopsAtTheLimitOfIterations) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_point", matcher);
  MinimizerOptions options = Options();
  options.max_iterations = 3;
  const MinimizerSummary summary = Minimize(objective, SE3d(), options);
  EXPECT_EQ(summary.termination, Termination::kMaxIterations);
  EXPECT_EQ(summary.iterates.size(), 4U);
}

TEST_P(BothModes, SaysWhenNoPairIsLeft) {
  const ClosestPointMatcher matcher(Room().source, Room().target, {1e-9});
  const Objective objective("point_to_plane", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
  EXPECT_EQ(summary.termination, Termination::kNoCorrespondences);
  EXPECT_FALSE(summary.Usable());
}

TEST_P(BothModes, IdenticalCloudsAreAPerfectFit) {
  const ClosestPointMatcher matcher(Room().target, Room().target);
  const Objective objective("point_to_plane", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
  ASSERT_TRUE(summary.Usable()) << summary.message;
  EXPECT_EQ(summary.final_cost(), 0);
  EXPECT_EQ(summary.T_target_source().Matrix(), SE3d().Matrix());
}

// A single plane leaves three degrees of freedom open: the others are found, nothing blows up.
TEST_P(BothModes, OnePlaneMovesOnlyWhereItIsSeen) {
  PointCloud source, target;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {
      testing_support::AddPoint({0.2 * i, 0.2 * j, -1.5}, &source);
      testing_support::AddPoint({0.2 * i, 0.2 * j, -1.7}, &target);
    }
  }
  EstimateNormals({}, 1, &target);
  const ClosestPointMatcher matcher(source, target);
  const Objective objective("point_to_plane", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
  ASSERT_TRUE(summary.Usable()) << summary.message;
  EXPECT_LT((summary.T_target_source().t() - Vec3(0, 0, -0.2)).norm(), 1e-3);
  EXPECT_LT(summary.final_cost(), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(
    Minimizer, BothModes,
    testing::Values(testing_support::Named<Reassociation>{"EveryStep", Reassociation::kEveryStep},
                    testing_support::Named<Reassociation>{"EveryEvaluation",
                                                          Reassociation::kEveryEvaluation}),
    testing::PrintToStringParamName());

// With a gate n changes from pose to pose. Whatever the modes make of that, a step that is short
// only because longer ones were rejected must not be called convergence.
TEST(Minimizer, GatedStepsEndAtTheMotion) {
  const ClosestPointMatcher matcher(Room().source, Room().target, {0.5});
  const Objective objective("point_to_plane", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), {});
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_LT(DistanceM(kMotion, summary.T_target_source()), 0.01);
  MinimizerOptions every_evaluation;
  every_evaluation.reassociation = Reassociation::kEveryEvaluation;
  for (const double gate : {0.1, 0.2, 0.3, 0.5}) {
    const ClosestPointMatcher tight(Room().source, Room().target, {gate});
    const MinimizerSummary end =
        Minimize(Objective("point_to_plane", tight), SE3d(), every_evaluation);
    if (end.termination == Termination::kConverged) {
      EXPECT_LT(DistanceM(kMotion, end.T_target_source()), 0.05) << "gate " << gate;
    }
  }
}

TEST_P(BothModes, SaysWhenEveryPairIsAnOutlier) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_point", matcher, MakeLoss("tukey", 1e-6));
  const MinimizerSummary summary =
      Minimize(objective, SE3d(Mat3::Identity(), Vec3(3, 0, 0)), Options());
  EXPECT_EQ(summary.termination, Termination::kFailure);
  EXPECT_FALSE(summary.Usable());
}

// From a start where every residual is saturated the loss is as upward as elsewhere.
TEST(Minimizer, TolerantLossFromFarAway) {
  PointCloud source, target;
  for (int i = 0; i < 100; ++i) {
    const Vec3 p(i % 10, i / 10, 0.1 * ((i * 7) % 13));
    testing_support::AddPoint(3 * p, &target);
    testing_support::AddPoint(3 * p + Vec3(0.5, 0.5, 0), &source);
  }
  const ClosestPointMatcher matcher(source, target);
  const Objective objective("point_to_point", matcher, MakeLoss("tolerant", 0.1));
  const MinimizerSummary summary = Minimize(objective, SE3d(), {});
  ASSERT_TRUE(summary.Usable()) << summary.message;
  EXPECT_LT(DistanceM(SE3d(Mat3::Identity(), Vec3(-0.5, -0.5, 0)), summary.T_target_source()),
            0.15);
}

// Besl and McKay: point-to-point ICP never raises its cost.
TEST(Minimizer, PointToPointDescendsMonotonically) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_point", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), {});
  ASSERT_GT(summary.iterates.size(), 5U);
  for (std::size_t i = 1; i < summary.iterates.size(); ++i) {
    EXPECT_LE(summary.iterates[i].cost, summary.iterates[i - 1].cost * (1 + 1e-12));
  }
}

// A loss with rho'' > 0 goes through one residual block per pair.
TEST(Minimizer, TolerantLossFallsBackToBlocks) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher, MakeLoss("tolerant", 0.05));
  const MinimizerSummary summary = Minimize(objective, SE3d(), {});
  ASSERT_TRUE(summary.Usable()) << summary.message;
  EXPECT_LT(DistanceM(kMotion, summary.T_target_source()), 0.02);
}

TEST(Minimizer, IsBitIdenticalForAnyNumberOfThreads) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  MinimizerOptions options;
  const SE3d one = Minimize(objective, SE3d(), options).T_target_source();
  options.threads = 3;
  EXPECT_EQ(one.Matrix(), Minimize(objective, SE3d(), options).T_target_source().Matrix());
}

TEST(Minimizer, RegistersTheRealTurnFromTheIdentity) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  ScanPair pair = OpenKittiSequence(KittiRoot(), "00").Pair(95, 94);
  EstimateNormals({}, 2, &pair.source);
  EstimateNormals({}, 2, &pair.target);
  const SE3d truth = *pair.T_ground_truth;
  const ClosestPointMatcher matcher(pair.source, pair.target);
  for (const Reassociation mode : {Reassociation::kEveryStep, Reassociation::kEveryEvaluation}) {
    for (const char* metric : {"point_to_plane", "symmetric"}) {
      const Objective objective(metric, matcher);
      MinimizerOptions options;
      options.reassociation = mode;
      options.threads = 2;
      const MinimizerSummary summary = Minimize(objective, SE3d(), options);
      ASSERT_TRUE(summary.Usable());
      EXPECT_LT(DistanceM(truth, summary.T_target_source()), 0.02) << metric;
      EXPECT_LT(AngleRad(truth, summary.T_target_source()), 0.1 * M_PI / 180) << metric;
    }
  }
}

}  // namespace
}  // namespace icpscape
