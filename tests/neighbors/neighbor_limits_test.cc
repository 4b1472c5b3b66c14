// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "icpscape/neighbors/neighbor_search.h"
#include "tests/support/scenes.h"
#include "tests/support/simd_levels.h"

namespace icpscape {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

PointCloud Cloud(const std::vector<Eigen::Vector3f>& points) {
  PointCloud cloud;
  for (const Eigen::Vector3f& p : points) {
    cloud.x.push_back(p.x());
    cloud.y.push_back(p.y());
    cloud.z.push_back(p.z());
  }
  return cloud;
}

class NeighborLimitsAt : public testing_support::EverySimdLevel {};
ICPSCAPE_INSTANTIATE_SIMD_LEVELS(NeighborLimitsAt);

// A limit whose square no float can hold is no limit: all points at finite distances are found.
TEST_P(NeighborLimitsAt, LimitsBeyondFloatsAreNone) {
  const PointCloud cloud = Cloud({{1e20F, 0, 0}, {1e18F, 0, 0}, {1, 0, 0}});
  const NeighborSearch search(cloud.View());
  const Eigen::Vector3f query(0, 0, 0);
  std::vector<Neighbor> found;
  search.WithinRadius(query, 1e30F, &found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].index, 1);
  Neighborhoods moments;
  search.WithinRadius(Cloud({query}).View(), 1e30F, &moments);
  EXPECT_EQ(moments.count[0], 2);
  EXPECT_EQ(search.Nearest(query, kInfinity).index, 2);
  // Also where the query before it has found something.
  std::vector<Eigen::Vector3f> queries(32, query);
  std::fill(queries.begin() + 16, queries.end(), Eigen::Vector3f(-1e20F, 0, 0));
  std::vector<std::int32_t> index(32);
  std::vector<float> squared_distance(32);
  search.Nearest(Cloud(queries).View(), kInfinity, index.data(), squared_distance.data());
  EXPECT_EQ(index[15], 2);
  EXPECT_EQ(index[16], -1);
}

// k below 1 counts as 1, and an empty cloud has no neighbours.
TEST_P(NeighborLimitsAt, FewerThanOneIsOne) {
  const PointCloud cloud = testing_support::Room(50, 11), queries = testing_support::Room(5, 12);
  const auto distance = [&](std::size_t i, int j) {
    return (queries.Point(i) - cloud.Point(static_cast<std::size_t>(j))).norm();
  };
  const NeighborSearch search(cloud.View());
  for (const int k : {0, -3}) {
    std::vector<Neighbor> found;
    search.KNearest(queries.View(), k, &found);
    Neighborhoods moments;
    search.KNearest(queries.View(), k, &moments);
    ASSERT_EQ(found.size(), queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      int nearest = 0;
      for (int j = 1; j < 50; ++j) {
        nearest = distance(i, j) < distance(i, nearest) ? j : nearest;
      }
      EXPECT_EQ(found[i].index, nearest);
      EXPECT_EQ(moments.nearest[i], nearest);
      EXPECT_EQ(moments.count[i], 1);
    }
  }
  const Neighbor none = search.Nearest({100, 100, 100}, 1);
  EXPECT_EQ(none.index, -1);
  EXPECT_EQ(none.squared_distance, 0);
}

}  // namespace
}  // namespace icpscape
