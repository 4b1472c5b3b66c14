// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/pull.h"

#include <gtest/gtest.h>

#include <map>

#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

// Source points along x, and the target 1 m beside each of them: eps is half a square metre a pair
// at T_0. T_1 brings them 0.6 m nearer: 0.08 m^2 a pair. At 19 m another target point is 0.9 m away
// on the other side: the pair there is another one at T_0, of 0.81 as much. Ranges at a bin's edge
// belong to the bin that it begins, and are the source's.
TEST(Pulls, ShareTheObjectiveOutByRangeAndClass) {
  PointCloud source, target;
  for (const double range_m : {2.0, 4.999, 5.0, 19.0, 20.0, 39.0, 40.0, 300.0}) {
    testing_support::AddPoint(Vec3(range_m, 0, 0), &source);
    testing_support::AddPoint(Vec3(range_m, 1, 0), &target);
    // Road, and from 20 m on another class; the upper half tells objects apart.
    source.label.push_back((range_m < 20 ? 40 : 252) + (static_cast<int>(range_m) << 16));
  }
  testing_support::AddPoint(Vec3(19, -0.9, 0), &target);
  const ClosestPointMatcher matcher(source, target);
  const Objective objective("point_to_point", matcher);
  const SE3d T_1(Mat3::Identity(), Vec3(0, 0.6, 0));
  std::map<std::string, Pull> pulls;
  for (const Pull& pull : Pulls(objective, SE3d(), T_1, 1)) {
    pulls[pull.group] = pull;
  }
  const std::map<std::string, int> expected = {
      {"0 to 5 m", 2},  {"5 to 10 m", 1}, {"10 to 20 m", 1}, {"20 to 40 m", 2},
      {"from 40 m", 2}, {"label 40", 4},  {"label 252", 4}};
  ASSERT_EQ(pulls.size(), expected.size());
  const double eps_of_one = objective.Evaluate(SE3d(), 1).epsilon / 7.81;
  EXPECT_GT(eps_of_one, 0);
  for (const auto& [group, n] : expected) {
    ASSERT_EQ(pulls.count(group), 1U) << group;
    EXPECT_EQ(pulls[group].n_0, n) << group;
    EXPECT_EQ(pulls[group].n_1, n) << group;
    const double other = group == "10 to 20 m" || group == "label 40" ? 0.19 : 0;
    EXPECT_NEAR(pulls[group].epsilon_0, (n - other) * eps_of_one, 1e-6) << group;
    EXPECT_NEAR(pulls[group].epsilon_1, n * eps_of_one * 0.16, 1e-6) << group;
  }
  source.label.clear();
  const ClosestPointMatcher unlabelled(source, target);
  EXPECT_EQ(Pulls(Objective("point_to_point", unlabelled), SE3d(), T_1, 1).size(), 5U);
}

}  // namespace
}  // namespace icpscape
