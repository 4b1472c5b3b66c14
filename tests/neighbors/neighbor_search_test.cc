// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/neighbors/neighbor_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <thread>

#include "icpscape/io/kitti.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"
#include "tests/support/simd_levels.h"

namespace icpscape {
namespace {

constexpr float kNoLimit = std::numeric_limits<float>::max();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool Before(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance < b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.index < b.index);
}

// The definition, by brute force: distances in float in this order, ties to the lower index.
std::vector<Neighbor> AllSorted(const PointCloud& cloud, const Eigen::Vector3f& q) {
  std::vector<Neighbor> all;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float dx = q.x() - cloud.x[i], dy = q.y() - cloud.y[i], dz = q.z() - cloud.z[i];
    const float squared_distance = (dx * dx + dy * dy) + dz * dz;
    if (squared_distance <= kNoLimit) {
      all.push_back({static_cast<int>(i), squared_distance});
    }
  }
  std::sort(all.begin(), all.end(), Before);
  return all;
}

void ExpectSame(const std::vector<Neighbor>& found, const std::vector<Neighbor>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].index, expected[i].index);
    EXPECT_EQ(found[i].squared_distance, expected[i].squared_distance);
  }
}

std::vector<Neighbor> First(const std::vector<Neighbor>& all, std::size_t k) {
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size()))};
}

Eigen::Vector3f PointOf(const PointCloud& cloud, std::size_t i) {
  return {cloud.x[i], cloud.y[i], cloud.z[i]};
}

// What only saves time changes no result, so that no test can miss it: the axis that a node splits,
// the nearer child first, a first guess, lanes left out early, k cut down to the points there are.

// Single queries, batches and moments, against the definition.
void ExpectEqualsBruteForce(const PointCloud& cloud, const PointCloud& queries) {
  const NeighborSearch search(cloud.View());
  const std::size_t size = queries.size();
  std::vector<std::int32_t> index(size);
  std::vector<float> squared_distance(size);
  search.Nearest(queries.View(), kNoLimit, index.data(), squared_distance.data());
  std::vector<Neighbor> five, found;
  search.KNearest(queries.View(), 5, &five);
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector3f q = PointOf(queries, i);
    const std::vector<Neighbor> all = AllSorted(cloud, q);
    ASSERT_EQ(index[i], all.empty() ? -1 : all[0].index);
    EXPECT_EQ(search.Nearest(q, kNoLimit).index, index[i]);
    for (const std::size_t k : {1UL, 5UL, 20UL, 40UL}) {
      search.KNearest(q, static_cast<int>(k), &found);
      ExpectSame(found, First(all, k));
    }
    const std::vector<Neighbor> first = First(all, 5);
    for (std::size_t n = 0; n < 5; ++n) {
      EXPECT_EQ(five[5 * i + n].index, n < first.size() ? first[n].index : -1);
    }
    const float radius = 0.75F;
    search.WithinRadius(q, radius, &found);
    const auto end = std::find_if(all.begin(), all.end(), [&](const Neighbor& n) {
      return n.squared_distance > radius * radius;
    });
    ExpectSame(found, {all.begin(), end});
    if (all.empty()) {
      continue;
    }
    EXPECT_EQ(squared_distance[i], all[0].squared_distance);
    // A gate exactly at the nearest distance lets it through; just below, nothing.
    EXPECT_EQ(search.Nearest(q, all[0].squared_distance).index, all[0].index);
    if (all[0].squared_distance > 0) {
      EXPECT_EQ(search.Nearest(q, std::nextafter(all[0].squared_distance, 0.F)).index, -1);
    }
  }
}

// Moments against sums over the neighbours that the definition names.
void ExpectMoments(const PointCloud& cloud, const PointCloud& queries, const Neighborhoods& found,
                   const std::function<std::vector<Neighbor>(std::vector<Neighbor>)>& select) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Eigen::Vector3f q = PointOf(queries, i);
    const std::vector<Neighbor> expected = select(AllSorted(cloud, q));
    ASSERT_EQ(found.count[i], static_cast<int>(expected.size()));
    if (expected.empty()) {
      EXPECT_EQ(found.nearest[i], -1);
      EXPECT_EQ(found.farthest_squared_distance[i], 0);
      continue;
    }
    EXPECT_EQ(found.nearest[i], expected.front().index);
    EXPECT_EQ(found.farthest_squared_distance[i], expected.back().squared_distance);
    const double radius = std::sqrt(expected.back().squared_distance);
    Vec3 sum = Vec3::Zero();
    Mat3 products = Mat3::Zero();
    for (const Neighbor& n : expected) {
      const Vec3 d = (PointOf(cloud, static_cast<std::size_t>(n.index)) - q).cast<double>();
      sum += d;
      products += d * d.transpose();
    }
    const double n = found.count[i];
    EXPECT_LE((Vec3(found.x[i], found.y[i], found.z[i]) - sum).norm(), 2e-7 * n * radius);
    EXPECT_LE((found.Products(i) - products).norm(), 4e-7 * n * radius * radius);
  }
}

void ExpectMomentsEqualBruteForce(const PointCloud& cloud, const PointCloud& queries) {
  const NeighborSearch search(cloud.View());
  Neighborhoods found;
  for (const int k : {1, 5, 20, 40}) {
    search.KNearest(queries.View(), k, &found);
    ExpectMoments(cloud, queries, found, [&](const std::vector<Neighbor>& all) {
      return First(all, static_cast<std::size_t>(k));
    });
  }
  const float radius = 0.75F;
  search.WithinRadius(queries.View(), radius, &found);
  ExpectMoments(cloud, queries, found, [&](std::vector<Neighbor> all) {
    all.erase(std::find_if(all.begin(), all.end(),
                           [&](const Neighbor& n) { return n.squared_distance > radius * radius; }),
              all.end());
    return all;
  });
}

PointCloud Cloud(const std::vector<Eigen::Vector3f>& points) {
  PointCloud cloud;
  for (const Eigen::Vector3f& p : points) {
    cloud.x.push_back(p.x());
    cloud.y.push_back(p.y());
    cloud.z.push_back(p.z());
  }
  return cloud;
}

PointCloud Uniform(int points, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(-5, 5);
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    testing_support::AddPoint({unit(engine), unit(engine), unit(engine)}, &cloud);
  }
  return cloud;
}

class NeighborSearchAt : public testing_support::EverySimdLevel {};
ICPSCAPE_INSTANTIATE_SIMD_LEVELS(NeighborSearchAt);

TEST_P(NeighborSearchAt, RandomPoints) {
  const PointCloud cloud = Uniform(2000, 1);
  const PointCloud queries = Uniform(101, 2);
  ExpectEqualsBruteForce(cloud, queries);
  ExpectMomentsEqualBruteForce(cloud, queries);
}

TEST_P(NeighborSearchAt, TiesAndDuplicatesGoToTheLowerIndex) {
  const PointCloud cloud = testing_support::CloudWithTies(3000, 1);
  PointCloud queries;
  for (std::size_t i = 0; i < 100; ++i) {
    testing_support::AddPoint(cloud.Point(i), &queries);
    testing_support::AddPoint(cloud.Point(i) + Vec3(0.25, -0.25, 0), &queries);
  }
  ExpectEqualsBruteForce(cloud, queries);
  ExpectMomentsEqualBruteForce(cloud, queries);
}

TEST_P(NeighborSearchAt, DegenerateClouds) {
  PointCloud equal, line, one, two;
  for (int i = 0; i < 100; ++i) {
    testing_support::AddPoint({1, 2, 3}, &equal);
    testing_support::AddPoint({0.1 * i, 0, 0}, &line);
  }
  testing_support::AddPoint({1, 2, 3}, &one);
  testing_support::AddPoint({1, 2, 3}, &two);
  testing_support::AddPoint({1, 2, 4}, &two);
  const PointCloud queries = Cloud({{1, 2, 3}, {0, 0, 0}, {100, -100, 50}});
  for (const PointCloud& cloud : {equal, line, one, two, PointCloud()}) {
    ExpectEqualsBruteForce(cloud, queries);
    ExpectMomentsEqualBruteForce(cloud, queries);
  }
}

// What many drivers write for "no return"; a tree of such points alone has one leaf.
TEST_P(NeighborSearchAt, AThousandReturnsAtTheOrigin) {
  PointCloud cloud = Uniform(500, 3);
  for (int i = 0; i < 1000; ++i) {
    testing_support::AddPoint({0, 0, 0}, &cloud);
  }
  PointCloud queries = Uniform(20, 4);
  testing_support::AddPoint({0, 0, 0}, &queries);
  ExpectEqualsBruteForce(cloud, queries);
  ExpectMomentsEqualBruteForce(cloud, queries);
}

TEST_P(NeighborSearchAt, WhatIsNotFiniteHasNoNeighborsAndIsNone) {
  PointCloud cloud = Uniform(300, 5);
  for (std::size_t i = 0; i < cloud.size(); i += 3) {
    cloud.x[i] = i % 2 == 0 ? kNaN : kInfinity;
    cloud.z[i + 1] = i % 2 == 0 ? -kInfinity : cloud.z[i + 1];
    cloud.y[i + 2] = i % 4 == 0 ? kNaN : cloud.y[i + 2];
  }
  PointCloud queries = Uniform(21, 6);
  for (std::size_t i = 0; i < queries.size(); i += 2) {
    queries.y[i] = i % 4 == 0 ? kNaN : -kInfinity;
  }
  // The brute force's distances are NaN or infinite there.
  ExpectEqualsBruteForce(cloud, queries);
  ExpectMomentsEqualBruteForce(cloud, queries);
  EXPECT_EQ(NeighborSearch(cloud.View()).Order().size(), 125U);
}

// Too far for the square of a float, and as near as floats can be.
TEST_P(NeighborSearchAt, ExtremeCoordinates) {
  const PointCloud cloud = Cloud({{3e38F, 0, 0}, {1e19F, 0, 0}, {1e-30F, 0, 0}, {0, 1e-40F, 0}});
  ExpectEqualsBruteForce(cloud, Cloud({{0, 0, 0}, {1e19F, 0, 0}, {-3e38F, 0, 0}}));
}

// From far away a float sees a whole wall at one distance.
TEST_P(NeighborSearchAt, ThousandsOfTies) {
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> unit(0, 1);
  PointCloud wall, queries;
  for (int i = 0; i < 20000; ++i) {
    testing_support::AddPoint({0.002 * unit(engine), 20 * unit(engine), 20 * unit(engine)}, &wall);
  }
  for (int i = 0; i < 17; ++i) {
    testing_support::AddPoint({1e5, 0.1 * i, 0}, &queries);
  }
  Neighborhoods found;
  NeighborSearch(wall.View()).KNearest(queries.View(), 5, &found);
  ExpectMoments(wall, queries, found,
                [](const std::vector<Neighbor>& all) { return First(all, 5); });
}

// Fewer than k can be reached: the rest is farther than a float can say.
TEST_P(NeighborSearchAt, FewerThanKAreWithinReach) {
  const PointCloud cloud = Cloud({{1e20F, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  Neighborhoods found;
  NeighborSearch(cloud.View()).KNearest(Cloud({{0, 0, 0}}).View(), 4, &found);
  EXPECT_EQ(found.count[0], 3);
  EXPECT_EQ(found.farthest_squared_distance[0], 1);
  EXPECT_EQ(found.Mean(0), Vec3::Constant(1. / 3));
  EXPECT_EQ(found.Products(0), Mat3::Identity());
}

TEST_P(NeighborSearchAt, ARadiusIsFineAsAThreadsFirstQuestion) {
  std::thread([] {
    const PointCloud cloud = Uniform(100, 10);
    Neighborhoods found;
    NeighborSearch(cloud.View()).WithinRadius(cloud.View(), 1, &found);
    EXPECT_GE(found.count[0], 1);
  }).join();
}

TEST_P(NeighborSearchAt, OrderIsAPermutationAndItsPointsFollow) {
  const PointCloud cloud = Uniform(777, 7);
  const NeighborSearch search(cloud.View());
  std::vector<std::int32_t> order = search.Order();
  for (std::size_t k = 0; k < order.size(); ++k) {
    EXPECT_EQ(search.OrderedPoints().x[k], cloud.x[static_cast<std::size_t>(order[k])]);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(order[i], static_cast<std::int32_t>(i));
  }
}

TEST_P(NeighborSearchAt, TheTreeIsTheSameForAnyThreads) {
  const PointCloud cloud = Uniform(5000, 8);
  const NeighborSearch one(cloud.View());
  for (const int threads : {2, 3, 4}) {
    EXPECT_EQ(NeighborSearch(cloud.View(), threads).Order(), one.Order());
  }
}

TEST_P(NeighborSearchAt, EqualsBruteForceOnARealScan) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::filesystem::path root = KittiRoot();
  DroppedPoints dropped;
  const KittiFiles sequence(root, "00");
  const PointCloud target = ReadVelodyne(sequence.Scan(94), &dropped);
  const PointCloud source = ReadVelodyne(sequence.Scan(95), &dropped);
  PointCloud queries;
  for (std::size_t i = 0; i < source.size(); i += source.size() / 40) {
    testing_support::AddPoint(source.Point(i), &queries);
  }
  ExpectEqualsBruteForce(target, queries);
  ExpectMomentsEqualBruteForce(target, queries);
}

}  // namespace
}  // namespace icpscape
