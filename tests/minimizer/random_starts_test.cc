// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/random_starts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.3, 0.05, -0.02).finished());

const testing_support::MovedRoom& Room() {
  static const testing_support::MovedRoom room(8000, kMotion);
  return room;
}

TEST(RandomStarts, StayWithinTheirLimitsAndRepeat) {
  RandomStartOptions options;
  options.count = 500;
  const std::vector<SE3d> starts = RandomStarts(kMotion, options);
  ASSERT_EQ(starts.size(), 500U);
  double longest = 0, largest = 0;
  for (const SE3d& start : starts) {
    longest = std::max(longest, (kMotion.Inverse() * start).t().norm());
    largest = std::max(largest, (kMotion.Inverse() * start).LogRotation().norm());
  }
  EXPECT_LE(longest, options.translation_m * 1.001);
  EXPECT_GE(longest, options.translation_m * 0.97);
  EXPECT_LE(largest, options.rotation_rad * 1.001);
  EXPECT_EQ(starts[7].Matrix(), RandomStarts(kMotion, options)[7].Matrix());
  options.seed = 2;
  EXPECT_NE(starts[7].Matrix(), RandomStarts(kMotion, options)[7].Matrix());
}

TEST(RandomStarts, StayWithinTheFreeDirections) {
  RandomStartOptions options;
  options.minimizer.free = kPlanarDof;
  const SE3d reference = kMotion;
  for (const SE3d& start : RandomStarts(reference, options)) {
    const Vec6 xi = (reference.Inverse() * start).Log();
    EXPECT_NEAR(xi.head<2>().norm() + std::abs(xi[5]), 0, 1e-12);
    EXPECT_GT(xi.segment<3>(2).norm(), 0);
  }
}

TEST(RandomStarts, CountFailures) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  RandomStartOptions options;
  options.count = 4;
  options.minimizer.max_iterations = 1;  // Too few to arrive from metres away.
  options.translation_m = 5;
  for (const StartResult& result : RunRandomStarts(objective, kMotion, options)) {
    EXPECT_EQ(result.success, result.end_m < kSuccessM && result.end_rad < kSuccessRad);
    if (result.start_m > 2) {
      EXPECT_FALSE(result.success);
    }
  }
}

TEST(RandomStarts, SucceedInARoom) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  RandomStartOptions options;
  options.count = 20;
  options.minimizer.threads = 2;
  const std::vector<StartResult> results = RunRandomStarts(objective, kMotion, options);
  ASSERT_EQ(results.size(), 20U);
  for (const StartResult& result : results) {
    EXPECT_TRUE(result.success);
    EXPECT_GT(result.start_m, 0);
    EXPECT_LT(result.end_m, kSuccessM);
  }
}

}  // namespace
}  // namespace icpscape
