// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/filter_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

PointCloud Row(const std::vector<float>& x) {
  PointCloud cloud;
  cloud.x = x;
  cloud.y.assign(x.size(), 0);
  cloud.z.assign(x.size(), 0);
  return cloud;
}

TEST(FilterStatistics, CountByRange) {
  const PointCloud cloud = Row({1, -9.5F, 10, 35, 36});
  const std::vector<RangeBin> bins = KeptByRange(cloud, {1, 0, 1, 0, 0}, 10);
  ASSERT_EQ(bins.size(), 4U);
  const std::size_t points[] = {2, 1, 0, 2};
  const std::size_t kept[] = {1, 1, 0, 0};
  for (std::size_t b = 0; b < 4; ++b) {
    EXPECT_EQ(bins[b].count.points, points[b]);
    EXPECT_EQ(bins[b].count.kept, kept[b]);
    EXPECT_EQ(bins[b].from_m, 10. * static_cast<double>(b));
    EXPECT_EQ(bins[b].to_m, bins[b].from_m + 10);
  }
  EXPECT_EQ(bins[0].count.Fraction(), 0.5);
  EXPECT_TRUE(std::isnan(bins[2].count.Fraction()));
  EXPECT_EQ(CountKept({1, 0, 1, 0, 0}).Fraction(), 0.4);
  EXPECT_THROW(KeptByRange(cloud, {1, 1, 1, 1, 1}, 0), UsageError);
}

TEST(FilterStatistics, ScoreTheRemovalOfDynamicPoints) {
  PointCloud cloud = Row({1, 2, 3, 4, 5, 6});
  const auto is_dynamic = [](std::int32_t label) { return label >= 7; };
  EXPECT_THROW(ScoreRemoval(cloud, std::vector<char>(6, 1), is_dynamic), InputError);
  cloud.label = {7, 8, 7, 0, 1, 0};
  // Removed: two dynamic points and one static.
  const RemovalScore score = ScoreRemoval(cloud, {0, 0, 1, 1, 0, 1}, is_dynamic);
  EXPECT_DOUBLE_EQ(score.Precision(), 2. / 3);
  EXPECT_DOUBLE_EQ(score.Recall(), 2. / 3);
  EXPECT_EQ(score.removed, 3U);
  const RemovalScore nothing = ScoreRemoval(cloud, std::vector<char>(6, 1), is_dynamic);
  EXPECT_TRUE(std::isnan(nothing.Precision()));
  EXPECT_EQ(nothing.Recall(), 0);
}

}  // namespace
}  // namespace icpscape
