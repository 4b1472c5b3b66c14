// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/minimizer.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>

#include "icpscape/cloud/normals.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/sequences.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/objective/loss.h"
#include "icpscape/residuals/registry.h"
#include "tests/minimizer/room.h"
#include "tests/support/matchers.h"
#include "tests/support/message_of.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing_support::AngleRad;
using testing_support::BothModes;
using testing_support::DistanceM;
using testing_support::kMotion;

const testing_support::MovedRoom& Room() { return testing_support::RoomOfKMotion(); }

using MinimizerInBothModes = BothModes;
INSTANTIATE_TEST_SUITE_P(Minimizer, MinimizerInBothModes, testing_support::EachMode(),
                         testing::PrintToStringParamName());

TEST_P(MinimizerInBothModes, FindsTheMotionWithEveryMetric) {
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

// Point-to-plane as the documentation has it, from a search that looks at every target point.
double PointToPlaneCost(const SE3d& T, double gate_m, const std::function<double(double)>& rho) {
  double cost = 0;
  for (std::size_t i = 0; i < Room().source.size(); ++i) {
    const Vec3 p = T * Room().source.Point(i);
    double least = gate_m * gate_m;
    double residual = std::nan("");
    for (std::size_t j = 0; j < Room().target.size(); ++j) {
      const Vec3 d = p - Room().target.Point(j);
      if (d.squaredNorm() < least) {
        least = d.squaredNorm();
        residual = Room().target.Normal(j).dot(d);
      }
    }
    cost += std::isnan(residual) ? 0 : 0.5 * rho(residual * residual);
  }
  return cost;
}

TEST_P(MinimizerInBothModes, ReportsTheReassociatedCostOfTheFinalPose) {
  const ClosestPointMatcher matcher(Room().source, Room().target, {1.0});
  constexpr double kScale_m = 0.05;
  const auto square = [](double s) { return s; };
  const auto huber = [](double s) {
    return std::sqrt(s) <= kScale_m ? s : 2 * kScale_m * std::sqrt(s) - kScale_m * kScale_m;
  };
  for (const char* loss : {"none", "huber"}) {
    const Objective objective("point_to_plane", matcher, MakeLoss(loss, kScale_m));
    const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
    ASSERT_TRUE(summary.Usable()) << loss;
    const double by_hand = loss == std::string("none")
                               ? PointToPlaneCost(summary.T_target_source(), 1, square)
                               : PointToPlaneCost(summary.T_target_source(), 1, huber);
    EXPECT_NEAR(summary.final_cost(), by_hand, 1e-5 * by_hand) << loss;
  }
}

// Every iterate is the re-associated objective at its pose, bit for bit.
TEST_P(MinimizerInBothModes, RecordsTheObjectiveAtEveryPose) {
  const ClosestPointMatcher matcher(Room().source, Room().target, {1.0});
  for (const char* loss : {"none", "huber", "tukey"}) {
    const Objective objective("point_to_plane", matcher, MakeLoss(loss, 0.05));
    const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
    ASSERT_TRUE(summary.Usable()) << loss;
    for (const Iterate& iterate : summary.iterates) {
      const Evaluation evaluation = objective.Evaluate(iterate.T_target_source, 1);
      EXPECT_EQ(iterate.cost, evaluation.sums.cost);
      EXPECT_EQ(iterate.n, evaluation.n());
      EXPECT_EQ(iterate.rmse, evaluation.Rmse());
      EXPECT_NEAR(iterate.gradient_norm, std::sqrt(evaluation.sums.gradient.array().square().sum()),
                  1e-12 * iterate.gradient_norm);
    }
    EXPECT_GT(summary.iterates.front().gradient_norm, 2 * summary.iterates.back().gradient_norm);
  }
}

// Counts how often all source points are matched.
class CountingMatcher final : public Matcher {
 public:
  explicit CountingMatcher(const Matcher& inner)
      : Matcher(inner.searchable_source(), inner.searchable_target()), inner_(inner) {}
  unsigned Provides() const override { return inner_.Provides(); }
  double passes() const {
    return static_cast<double>(points_) / static_cast<double>(source().size());
  }

 private:
  void FindPart(const SE3d& T, std::size_t begin, std::size_t end,
                Matches* matches) const override {
    points_ += end - begin;
    inner_.MatchPart(T, begin, end, matches);
  }

  const Matcher& inner_;
  mutable std::atomic<std::size_t> points_{0};
};

TEST_P(MinimizerInBothModes, CountsItsMatchingPasses) {
  const ClosestPointMatcher inner(Room().source, Room().target);
  const CountingMatcher matcher(inner);
  const MinimizerSummary summary =
      Minimize(Objective("point_to_plane", matcher), SE3d(), Options());
  EXPECT_EQ(summary.matching_passes, matcher.passes());
  EXPECT_GE(summary.matching_passes, static_cast<int>(summary.iterates.size()));
}

TEST_P(MinimizerInBothModes, RecordsStepsAndTimes) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  const auto start = std::chrono::steady_clock::now();
  const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
  const double whole_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_GT(summary.iterates.size(), 2U);
  EXPECT_EQ(summary.iterates[0].T_target_source.Matrix(), SE3d().Matrix());
  EXPECT_EQ(summary.iterates[0].step_m, 0);
  for (std::size_t i = 1; i < summary.iterates.size(); ++i) {
    EXPECT_NEAR(
        summary.iterates[i].step_m,
        DistanceM(summary.iterates[i - 1].T_target_source, summary.iterates[i].T_target_source),
        1e-14);
    EXPECT_NEAR(
        summary.iterates[i].step_rad,
        AngleRad(summary.iterates[i - 1].T_target_source, summary.iterates[i].T_target_source),
        1e-15);
    EXPECT_GT(summary.iterates[i].time_s, summary.iterates[i - 1].time_s);
  }
  EXPECT_LE(summary.iterates.back().time_s, whole_s);
}

// Eigenvalues by another algorithm: the general solver, which does not know that H is symmetric. A
// turn about the centroid c by 1/10 rad moves the origin by -omega x c.
TEST_P(MinimizerInBothModes, RecordsTheEigenvaluesOfTheFreeDirections) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  for (const DofMask& mask : {kAllDof, kPlanarDof}) {
    MinimizerOptions options = Options();
    options.free = mask;
    const Iterate last = Minimize(objective, SE3d(), options).iterates.back();
    Mat6 motions = Mat6::Identity();
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 omega = Vec3::Unit(axis) / 10;
      motions.col(axis) << omega, -omega.cross(CentroidOf(Room().source));
    }
    const Mat6 H =
        motions.transpose() * objective.Evaluate(last.T_target_source, 1).sums.Hessian() * motions;
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
TEST_P(MinimizerInBothModes, MovesInTheFreeDirectionsAlone) {
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
  if (Mode() == Reassociation::kEveryStep) {
    settles_in_the_plane("tolerant");  // One residual block per pair: the same manifold.
  }
}

TEST_P(MinimizerInBothModes, NeedsAFreeDirection) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  MinimizerOptions options = Options();
  options.free = {};
  const Objective objective("point_to_plane", matcher);
  EXPECT_EQ(testing_support::MessageOf<UsageError>([&] { Minimize(objective, SE3d(), options); }),
            "No direction is free; expected at least one.");
}

TEST_P(MinimizerInBothModes, ShowsEveryIterateToTheObserver) {
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

TEST_P(MinimizerInBothModes, IdenticalCloudsAreAPerfectFit) {
  const ClosestPointMatcher matcher(Room().target, Room().target);
  const Objective objective("point_to_plane", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
  ASSERT_TRUE(summary.Usable()) << summary.message;
  EXPECT_EQ(summary.final_cost(), 0);
  EXPECT_EQ(summary.T_target_source().Matrix(), SE3d().Matrix());
}

// A single plane leaves three degrees of freedom open: the others are found, nothing blows up.
TEST_P(MinimizerInBothModes, OnePlaneMovesOnlyWhereItIsSeen) {
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
