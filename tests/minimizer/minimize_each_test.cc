// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/minimize_each.h"

#include <gtest/gtest.h>

#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

TEST(MinimizeEach, IsEveryMetricAlone) {
  const SE3d motion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.3, 0.05, -0.02).finished());
  const testing_support::MovedRoom room(2000, motion);
  const ClosestPointMatcher matcher(room.source, room.target);
  const std::vector<Objective> objectives = {Objective("symmetric", matcher),
                                             Objective("point_to_plane", matcher)};
  MinimizerOptions options;
  options.max_iterations = 7;
  const SE3d start = SE3d::Exp((Vec6() << 0, 0, 0.02, 0.1, 0, 0).finished());
  const std::vector<MetricIterates> all = MinimizeEach(objectives, start, options);
  ASSERT_EQ(all.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(all[i].metric, objectives[i].metric().name);
    const MinimizerSummary alone = Minimize(objectives[i], start, options);
    ASSERT_EQ(all[i].summary.iterates.size(), alone.iterates.size());
    EXPECT_EQ(all[i].summary.final_cost(), alone.final_cost());
    EXPECT_EQ(all[i].summary.iterates[0].T_target_source.Matrix(), start.Matrix());
  }
  EXPECT_NE(all[0].summary.final_cost(), all[1].summary.final_cost());
}

}  // namespace
}  // namespace icpscape
