// SPDX-License-Identifier: BSD-3-Clause
// How the closed loop ends.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/minimizer/minimizer.h"
#include "icpscape/objective/loss.h"
#include "tests/minimizer/room.h"

namespace icpscape {
namespace {

using testing_support::BothModes;
using testing_support::DistanceM;
using testing_support::kMotion;

const testing_support::MovedRoom& Room() { return testing_support::RoomOfKMotion(); }

using TerminationInBothModes = BothModes;
INSTANTIATE_TEST_SUITE_P(Minimizer, TerminationInBothModes, testing_support::EachMode(),
                         testing::PrintToStringParamName());

TEST_P(TerminationInBothModes, StopsByTheCost) {
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

  // A cost that is the limit reaches it.
  options.max_final_cost = whole[2].cost;
  EXPECT_EQ(Minimize(objective, SE3d(), options).iterates.size(), 3U);

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

TEST_P(TerminationInBothModes, StopsAtTheLimitOfIterations) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_point", matcher);
  MinimizerOptions options = Options();
  options.max_iterations = 3;
  const MinimizerSummary summary = Minimize(objective, SE3d(), options);
  EXPECT_EQ(summary.termination, Termination::kMaxIterations);
  EXPECT_EQ(summary.iterates.size(), 4U);
}

TEST_P(TerminationInBothModes, SaysWhenNoPairIsLeft) {
  const ClosestPointMatcher matcher(Room().source, Room().target, {1e-9});
  const Objective objective("point_to_plane", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), Options());
  EXPECT_EQ(summary.termination, Termination::kNoCorrespondences);
  EXPECT_FALSE(summary.Usable());
}

// The step ends the loop that is shorter than both limits. With either limit out of the way the
// other one decides, here between the first step and the second.
TEST_P(TerminationInBothModes, EndsAtAStepThatIsShorterThanBothLimits) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  MinimizerOptions options = Options();
  options.min_step_m = options.min_step_rad = 0;
  const std::vector<Iterate> whole = Minimize(objective, SE3d(), options).iterates;
  ASSERT_GT(whole.size(), 2U);
  const double between_m = std::sqrt(whole[1].step_m * whole[2].step_m);
  const double between_rad = std::sqrt(whole[1].step_rad * whole[2].step_rad);
  ASSERT_GT(whole[1].step_m, 1.1 * between_m);
  ASSERT_GT(whole[1].step_rad, 1.1 * between_rad);
  constexpr double kNoLimit = 1e9;
  for (const auto& [limit_m, limit_rad] :
       {std::pair(between_m, kNoLimit), std::pair(kNoLimit, between_rad)}) {
    options.min_step_m = limit_m;
    options.min_step_rad = limit_rad;
    const MinimizerSummary summary = Minimize(objective, SE3d(), options);
    EXPECT_EQ(summary.termination, Termination::kConverged);
    // Every step does not take the short one; every evaluation is there when it knows.
    EXPECT_EQ(summary.iterates.size(), Mode() == Reassociation::kEveryStep ? 2U : 3U)
        << limit_m << " m, " << limit_rad << " rad";
  }
}

// With a gate n changes from pose to pose.
TEST(Termination, OfGatedStepsIsAtTheMotion) {
  const ClosestPointMatcher matcher(Room().source, Room().target, {0.5});
  const Objective objective("point_to_plane", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), {});
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_LT(DistanceM(kMotion, summary.T_target_source()), 0.01);
}

// Every evaluation compares sums over all pairs. Of a tight gate every step to the motion brings
// more of them: no step lowers the sum, and where that ends must not be called convergence.
TEST(Termination, OfGatedEvaluationsIsConvergenceAtTheMotionAlone) {
  MinimizerOptions options;
  options.reassociation = Reassociation::kEveryEvaluation;
  const auto end = [&](double gate_m) {
    const ClosestPointMatcher gated(Room().source, Room().target, {gate_m});
    return Minimize(Objective("point_to_plane", gated), SE3d(), options);
  };
  for (const double tight_m : {0.1, 0.2}) {
    EXPECT_EQ(end(tight_m).termination, Termination::kNoDescent) << tight_m;
    EXPECT_GT(DistanceM(kMotion, end(tight_m).T_target_source()), 0.1) << tight_m;
  }
  for (const double wide_m : {0.3, 0.5}) {
    EXPECT_EQ(end(wide_m).termination, Termination::kConverged) << wide_m;
    EXPECT_LT(DistanceM(kMotion, end(wide_m).T_target_source()), 0.01) << wide_m;
  }
}

TEST_P(TerminationInBothModes, SaysWhenEveryPairIsAnOutlier) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_point", matcher, MakeLoss("tukey", 1e-6));
  const MinimizerSummary summary =
      Minimize(objective, SE3d(Mat3::Identity(), Vec3(3, 0, 0)), Options());
  EXPECT_EQ(summary.termination, Termination::kFailure);
  EXPECT_FALSE(summary.Usable());
}

}  // namespace
}  // namespace icpscape
