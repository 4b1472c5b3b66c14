// SPDX-License-Identifier: BSD-3-Clause
#include "src/neighbors/neighbor_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "src/io/kitti.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

// The definition, by brute force: distances in float in this order, ties to the lower index.
std::vector<Neighbor> AllSorted(const PointCloud& cloud, const Eigen::Vector3f& q) {
  std::vector<Neighbor> all(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float dx = q.x() - cloud.x[i], dy = q.y() - cloud.y[i], dz = q.z() - cloud.z[i];
    all[i] = {static_cast<int>(i), (dx * dx + dy * dy) + dz * dz};
  }
  std::sort(all.begin(), all.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.squared_distance < b.squared_distance ||
           (a.squared_distance == b.squared_distance && a.index < b.index);
  });
  return all;
}

void ExpectSame(const std::vector<Neighbor>& found, const std::vector<Neighbor>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].index, expected[i].index);
    EXPECT_EQ(found[i].squared_distance, expected[i].squared_distance);
  }
}

void ExpectEqualsBruteForce(const PointCloud& cloud, const std::vector<Eigen::Vector3f>& queries) {
  const NeighborSearch search(cloud.View());
  std::vector<Neighbor> found;
  for (const Eigen::Vector3f& q : queries) {
    const std::vector<Neighbor> all = AllSorted(cloud, q);
    const Neighbor nearest = search.Nearest(q, std::numeric_limits<float>::max());
    EXPECT_EQ(nearest.index, all[0].index);
    EXPECT_EQ(nearest.squared_distance, all[0].squared_distance);
    for (const std::size_t k : {1UL, 5UL, 20UL}) {
      search.KNearest(q, static_cast<int>(k), &found);
      const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size()));
      ExpectSame(found, {all.begin(), end});
    }
    const float radius = 0.75F;
    search.WithinRadius(q, radius, &found);
    const auto end = std::find_if(all.begin(), all.end(), [&](const Neighbor& n) {
      return n.squared_distance > radius * radius;
    });
    ExpectSame(found, {all.begin(), end});
    // A gate exactly at the nearest distance lets it through; just below, nothing.
    EXPECT_EQ(search.Nearest(q, all[0].squared_distance).index, all[0].index);
    if (all[0].squared_distance > 0) {
      EXPECT_EQ(search.Nearest(q, std::nextafter(all[0].squared_distance, 0.F)).index, -1);
    }
  }
}

TEST(NeighborSearch, TiesAndDuplicatesGoToTheLowerIndex) {
  const PointCloud cloud = testing_support::CloudWithTies(3000, 1);
  std::vector<Eigen::Vector3f> queries;
  for (std::size_t i = 0; i < 200; ++i) {
    queries.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
    queries.emplace_back(cloud.x[i] + 0.25F, cloud.y[i] - 0.25F, cloud.z[i]);
  }
  ExpectEqualsBruteForce(cloud, queries);
}

TEST(NeighborSearch, DegenerateClouds) {
  PointCloud equal, line, one;
  for (int i = 0; i < 100; ++i) {
    testing_support::AddPoint({1, 2, 3}, &equal);
    testing_support::AddPoint({0.1 * i, 0, 0}, &line);
  }
  testing_support::AddPoint({1, 2, 3}, &one);
  const std::vector<Eigen::Vector3f> queries = {{1, 2, 3}, {0, 0, 0}, {100, -100, 50}};
  ExpectEqualsBruteForce(equal, queries);
  ExpectEqualsBruteForce(line, queries);
  ExpectEqualsBruteForce(one, queries);
}

TEST(NeighborSearch, EmptyCloudHasNoNeighbors) {
  const PointCloud empty;
  const NeighborSearch search(empty.View());
  std::vector<Neighbor> found;
  EXPECT_EQ(search.Nearest({0, 0, 0}, 1e30F).index, -1);
  search.KNearest(Eigen::Vector3f(0, 0, 0), 5, &found);
  EXPECT_TRUE(found.empty());
  search.WithinRadius(Eigen::Vector3f(0, 0, 0), 5, &found);
  EXPECT_TRUE(found.empty());
}

TEST(NeighborSearch, EqualsBruteForceOnARealScan) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::filesystem::path root = KittiRoot();
  DroppedPoints dropped;
  const KittiSequence sequence(root, "00");
  const PointCloud target = ReadVelodyne(sequence.ScanPath(94), &dropped);
  const PointCloud source = ReadVelodyne(sequence.ScanPath(95), &dropped);
  std::vector<Eigen::Vector3f> queries;
  for (std::size_t i = 0; i < source.size(); i += source.size() / 40) {
    queries.emplace_back(source.x[i], source.y[i], source.z[i]);
  }
  ExpectEqualsBruteForce(target, queries);
}

}  // namespace
}  // namespace icpscape
