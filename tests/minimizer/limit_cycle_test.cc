// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/minimizer/minimizer.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

// Two copies of a cloud, 0.1 m ahead and 0.1 m behind: from ahead the one behind is matched, and
// the other way round, so that ICP goes back and forth. The copy behind is noisy.
class BackAndForth final : public Matcher {
 public:
  BackAndForth(const PointCloud& source, const PointCloud& target) : Matcher(source, target) {}
  unsigned Provides() const override { return kPointsOnly; }

 private:
  void FindPart(const SE3d& T, std::size_t begin, std::size_t end,
                Matches* matches) const override {
    const auto other = static_cast<std::int32_t>(T.t().x() > 0 ? source().size() : 0);
    matches->target_index.clear();
    for (std::size_t k = begin; k < end; ++k) {
      matches->target_index.push_back(Order()[k] + other);
    }
  }
};

TEST(LimitCycle, EndsAtItsBestPose) {
  const PointCloud source = testing_support::Room(500, 1);
  PointCloud target;
  for (const double shift : {0.1, -0.1}) {
    for (std::size_t i = 0; i < source.size(); ++i) {
      const double noise = shift < 0 && i % 2 == 0 ? 0.05 : 0.0;
      testing_support::AddPoint(source.Point(i) + Vec3(shift, noise, 0), &target);
    }
  }
  const BackAndForth matcher(source, target);
  const Objective objective("point_to_point", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(Mat3::Identity(), Vec3(0.3, 0, 0)), {});
  EXPECT_EQ(summary.termination, Termination::kLimitCycle);
  EXPECT_TRUE(summary.Usable());
  EXPECT_LT(summary.iterates.size(), 8U);
  // Matched from behind to the copy ahead: rms sqrt(0.2^2); from ahead to the noisy one: more.
  EXPECT_NEAR(summary.T_target_source().t().x(), -0.1, 1e-3);
  EXPECT_NEAR(summary.iterates.back().rmse, 0.2, 0.03);
  EXPECT_NEAR(summary.cycle_m, 0.2, 0.01);  // From -0.1 to 0.1 m.
}

// Slow convergence is none: Huber's loss over a room from far away comes closer at every step.
TEST(LimitCycle, IsNotSeenInConvergence) {
  const testing_support::MovedRoom room(4000, SE3d(Mat3::Identity(), Vec3(0.5, 0.2, 0)));
  const ClosestPointMatcher matcher(room.source, room.target);
  MinimizerOptions options;
  options.max_iterations = 200;
  EXPECT_EQ(Minimize(Objective("point_to_point", matcher), SE3d(), options).termination,
            Termination::kConverged);
}

}  // namespace
}  // namespace icpscape
