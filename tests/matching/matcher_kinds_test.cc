// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/matcher_kinds.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/scenes.h"

namespace icpscape {
namespace {

TEST(MatcherKinds, AreFoundByWhatTheyProvide) {
  const auto clouds = [](unsigned needs) { return MatcherKindFor(needs).clouds; };
  EXPECT_EQ(clouds(kPointsOnly), &MetricClouds::points);
  EXPECT_EQ(clouds(kSourceNormal | kTargetNormal), &MetricClouds::points);
  EXPECT_EQ(clouds(kTargetLine), &MetricClouds::edges);
  EXPECT_EQ(clouds(kTargetPatch), &MetricClouds::planar);
  EXPECT_FALSE(MatcherKindFor(kTargetNormal).WorksOnFeatures());
  EXPECT_TRUE(MatcherKindFor(kTargetLine).WorksOnFeatures());
  EXPECT_TRUE(MatcherKindFor(kTargetPatch).WorksOnFeatures());
  EXPECT_DEATH(MatcherKindFor(kTargetLine | kTargetNormal),
               "no matcher provides target normals, line through neighbours");
}

TEST(MatcherKinds, MakeMatchersOverTheCloudsThatProvideIt) {
  const PointCloud source = testing_support::Room(50, 1);
  const PointCloud target = testing_support::Room(60, 2);
  for (const MatcherKind& kind : AllMatcherKinds()) {
    const std::unique_ptr<Matcher> matcher = kind.make(source, target, {});
    EXPECT_EQ(matcher->Provides(), kind.provides) << kind.clouds_name;
    EXPECT_EQ(matcher->source().size(), 50U) << kind.clouds_name;
    EXPECT_EQ(matcher->target().size(), 60U) << kind.clouds_name;
  }
}

// Each with its own options: a gate of 1 mm, lines of 3 neighbours, patches of 50.
TEST(MatcherKinds, TakeTheirOwnOptions) {
  const PointCloud source = testing_support::Room(50, 1);
  const PointCloud target = testing_support::Room(40, 2);
  MatcherOptions options;
  options.matching.max_distance_m = 0.001;
  options.line.num_neighbors = 3;
  options.line.eigenvalue_ratio = 0;
  options.patch = options.line;
  options.patch.num_neighbors = 50;  // More than there are.
  options.patch.max_smallest_eigenvalue_m2 = 1e9;
  const auto count = [&](unsigned needs) {
    Matches matches;
    MatcherKindFor(needs).make(source, target, options)->Match(SE3d(), 1, &matches);
    return matches.Count();
  };
  EXPECT_EQ(count(kPointsOnly), 0U);
  EXPECT_EQ(count(kTargetLine), 50U);
  EXPECT_EQ(count(kTargetPatch), 0U);
  options.matching.max_distance_m = 0;
  std::swap(options.line, options.patch);
  EXPECT_EQ(count(kPointsOnly), 50U);
  EXPECT_EQ(count(kTargetLine), 0U);
  EXPECT_EQ(count(kTargetPatch), 50U);
}

}  // namespace
}  // namespace icpscape
