// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/closest_point_matcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::ElementsAre;
using testing_support::AddPoint;

// Seven points along x, 20 m apart, with their matches off by these lengths across (m). The normals
// of the sixth pair form an angle of 0.5 rad; the second match has a source point that is nearer to
// it, 0.3 m from the second, and is the seventh point.
struct Scene {
  PointCloud source, target;
  Scene() {
    const double off[] = {0.1, 0.2, 0.3, 0.45, 0.55, 0.05};
    for (int i = 0; i < 6; ++i) {
      AddPoint({20.0 * i + 1, 1, 1}, &source);
      AddPoint({20.0 * i + 1, 1 + off[i], 1}, &target);
    }
    AddPoint({21, 1.3, 1}, &source);
    for (PointCloud* cloud : {&source, &target}) {
      cloud->nx.assign(cloud->size(), 0);
      cloud->ny.assign(cloud->size(), 0);
      cloud->nz.assign(cloud->size(), 1);
    }
    source.ny[5] = static_cast<float>(std::sin(0.5));
    source.nz[5] = static_cast<float>(std::cos(0.5));
  }
  std::vector<std::int32_t> Match(const MatchingOptions& options) const {
    Matches matches;
    ClosestPointMatcher(source, target, options).Match(SE3d(), 2, &matches);
    return matches.target_index;
  }
};

TEST(ClosestPointMatcher, MatchesEveryPointUnlessAskedToReject) {
  EXPECT_THAT(Scene().Match({}), ElementsAre(0, 1, 2, 3, 4, 5, 1));
  EXPECT_FALSE(MatchingOptions().Rejects());
}

TEST(ClosestPointMatcher, GatesByTheDistanceNotItsSquare) {
  MatchingOptions options;
  options.max_distance_m = 0.5;
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, 3, -1, 5, 1));
  options.max_distance_m = 0.25;
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, -1, -1, -1, 5, 1));
}

TEST(ClosestPointMatcher, RejectsWhatDoesNotLeadBack) {
  MatchingOptions options;
  options.reciprocal_epsilon_m = 0;
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, -1, 2, 3, 4, 5, 1));
  options.reciprocal_epsilon_m = 0.31;
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, 3, 4, 5, 1));
}

TEST(ClosestPointMatcher, RejectsByTheAngleOfTheNormals) {
  MatchingOptions options;
  options.max_normal_angle_rad = 0.49;
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, 3, 4, -1, 1));
  options.max_normal_angle_rad = 0.51;
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, 3, 4, 5, 1));
}

// Sorted: 0.05, 0.1, 0.1, 0.2, 0.3, 0.45, 0.55. The median is 0.2 m.
TEST(ClosestPointMatcher, RejectsBeyondAMultipleOfTheMedian) {
  MatchingOptions options;
  options.max_median_factor = 1.6;
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, -1, -1, 5, 1));
  options.max_median_factor = 2.3;
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, 3, -1, 5, 1));
}

TEST(ClosestPointMatcher, KeepsTheClosestShare) {
  MatchingOptions options;
  options.kept_fraction = 0.7;  // 4.9 of seven.
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, -1, -1, 5, 1));
}

// Cubes of 20 m hold one pair each but for the second: means 0.1, 0.15, 0.3, 0.45, 0.55, 0.05, and
// the lower median is 0.15. Those of 10 m would be the same; those of 60 m mean 0.175 and 0.35.
TEST(ClosestPointMatcher, RejectsRegions) {
  MatchingOptions options;
  options.regions = RegionOptions{20, 2.5};
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, -1, -1, 5, 1));
  options.regions = RegionOptions{60, 2.5};
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, 3, 4, 5, 1));
  options.regions = RegionOptions{60, 1.9};
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, 1, 2, -1, -1, -1, 1));
  options.regions = RegionOptions();
  EXPECT_EQ(options.regions->region_size_m, 10);
  EXPECT_EQ(options.regions->median_factor, 2);
}

// In the order of the options: the statistics of each are over what those before have left.
TEST(ClosestPointMatcher, RejectsInOrder) {
  MatchingOptions options;
  options.reciprocal_epsilon_m = 0;     // Leaves 0.1, 0.3, 0.45, 0.55, 0.05 and 0.1 m.
  options.max_normal_angle_rad = 0.49;  // Leaves 0.1, 0.3, 0.45, 0.55 and 0.1 m: median 0.3.
  options.max_median_factor = 1.6;      // Leaves 0.1, 0.3, 0.45 and 0.1 m.
  options.kept_fraction = 0.75;         // Leaves 0.1, 0.3 and 0.1 m.
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, -1, 2, -1, -1, -1, 1));
  options.regions = RegionOptions{20, 2};  // Means 0.1, 0.3 and 0.1 m.
  EXPECT_THAT(Scene().Match(options), ElementsAre(0, -1, -1, -1, -1, -1, 1));
}

// A gate is applied while matching; the other rejections have to see all pairs first.
TEST(ClosestPointMatcher, SaysWhichOptionsReject) {
  const Scene scene;
  const auto expect = [&](const MatchingOptions& options, bool needs_all_pairs) {
    EXPECT_TRUE(options.Rejects());
    EXPECT_EQ(ClosestPointMatcher(scene.source, scene.target, options).Rejects(), needs_all_pairs);
  };
  MatchingOptions gate, reciprocal, angle, median, share, regions;
  gate.max_distance_m = 0.5;
  reciprocal.reciprocal_epsilon_m = 0;
  angle.max_normal_angle_rad = 0.5;
  median.max_median_factor = 3;
  share.kept_fraction = 0.9;
  regions.regions = RegionOptions();
  expect(gate, false);
  for (const MatchingOptions& options : {reciprocal, angle, median, share, regions}) {
    expect(options, true);
  }
}

}  // namespace
}  // namespace icpscape
