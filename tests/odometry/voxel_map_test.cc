// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/voxel_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "tests/support/message_of.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing_support::AddPoint;
using testing_support::MessageOf;

PointCloud Cloud(const std::vector<Vec3>& points) {
  PointCloud cloud;
  for (const Vec3& p : points) {
    AddPoint(p, &cloud);
  }
  return cloud;
}

SE3d Forward(double x) { return SE3d(Mat3::Identity(), Vec3(x, 0, 0)); }

TEST(VoxelMap, KeepsTheFirstPointOfAVoxel) {
  VoxelMap map(0.5);
  map.Insert(Cloud({{0.1, 0, 0}, {0.4, 0, 0}, {0.6, 0, 0}, {-0.1, 0, 0}}), SE3d(), 0);
  EXPECT_THAT(map.Cloud(SE3d()).x, ElementsAre(0.1F, 0.6F, -0.1F));
  map.Insert(Cloud({{0.3, 0, 0}, {1.2, 0, 0}, {0.5, 0, 0}}), SE3d(), 1);
  EXPECT_THAT(map.Cloud(SE3d()).x, ElementsAre(0.1F, 0.6F, -0.1F, 1.2F));
  EXPECT_EQ(map.size(), 4U);
}

TEST(VoxelMap, PlacesAScanByItsPose) {
  VoxelMap map(1);
  map.Insert(Cloud({{0.5, 0, 0}}), Forward(10), 0);
  map.Insert(Cloud({{-1.9, 0, 0}}), Forward(12), 1);  // The same voxel, [10, 11).
  map.Insert(Cloud({{0.5, 0, 0}}), Forward(11), 2);
  EXPECT_THAT(map.Cloud(SE3d()).x, ElementsAre(10.5F, 11.5F));
}

TEST(VoxelMap, ForgetsOldScans) {
  VoxelMap map(0.5);
  for (int scan = 0; scan < 4; ++scan) {
    map.Insert(Cloud({{scan + 0.1, 0, 0}, {0.1, 0, 0}}), SE3d(), scan);
  }
  map.RemoveBefore(0);
  EXPECT_EQ(map.size(), 4U);
  map.RemoveBefore(2);
  EXPECT_THAT(map.Cloud(SE3d()).x, ElementsAre(2.1F, 3.1F));
  map.Insert(Cloud({{0.3, 0, 0}, {2.2, 0, 0}}), SE3d(),
             4);  // Its voxel is free again; the other not.
  EXPECT_THAT(map.Cloud(SE3d()).x, ElementsAre(2.1F, 3.1F, 0.3F));
}

TEST(VoxelMap, ForgetsWhatIsFarAway) {
  VoxelMap map(0.5);
  map.Insert(Cloud({{10, 0, 0}, {3, 4.6, 0}, {3, 4, 0}, {6, 0, 5}, {11.1, 0, 0}}), SE3d(), 0);
  map.RemoveBeyond(Vec3(6, 0, 0), 5);  // The point at the border stays.
  EXPECT_THAT(map.Cloud(SE3d()).x, ElementsAre(10, 3, 6));
  EXPECT_THAT(map.Cloud(SE3d()).y, ElementsAre(0, 4, 0));
  map.Insert(Cloud({{3.2, 4.2, 0}, {3.2, 4.8, 0}, {11.2, 0, 0}}), SE3d(), 1);
  EXPECT_THAT(map.Cloud(SE3d()).x, ElementsAre(10, 3, 6, 3.2F, 11.2F));
}

// A quarter turn to the left, in and out.
TEST(VoxelMap, TurnsNormalsWithTheirScanAndView) {
  const SE3d quarter = SE3d::Exp((Vec6() << 0, 0, M_PI / 2, 0, 0, 0).finished());
  PointCloud scan = Cloud({{2, 0, 0}, {4, 0, 0}});
  scan.nx = {-1, 0}, scan.ny = {0, 0}, scan.nz = {0, 0};
  VoxelMap map(0.5);
  map.Insert(scan, quarter, 0);
  const PointCloud world = map.Cloud(SE3d());
  ASSERT_TRUE(world.has_normals());
  EXPECT_NEAR((world.Point(0) - Vec3(0, 2, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((world.Normal(0) - Vec3(0, -1, 0)).norm(), 0, 1e-6);
  EXPECT_TRUE(world.NormalIsValid(0));
  EXPECT_FALSE(world.NormalIsValid(1));  // None stays none.
  const PointCloud back = map.Cloud(quarter.Inverse());
  EXPECT_NEAR((back.Point(0) - Vec3(2, 0, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((back.Normal(0) - Vec3(-1, 0, 0)).norm(), 0, 1e-6);
}

TEST(VoxelMap, HasNormalsWhereAllScansHadThem) {
  PointCloud with = Cloud({{2, 0, 0}});
  with.nx = {1}, with.ny = {0}, with.nz = {0};
  VoxelMap map(0.5);
  map.Insert(with, SE3d(), 0);
  EXPECT_TRUE(map.Cloud(SE3d()).has_normals());
  map.Insert(PointCloud(), SE3d(), 1);
  EXPECT_TRUE(map.Cloud(SE3d()).has_normals());
  map.Insert(Cloud({{4, 0, 0}}), SE3d(), 2);
  EXPECT_EQ(map.Cloud(SE3d()).size(), 2U);
  EXPECT_FALSE(map.Cloud(SE3d()).has_normals());
}

TEST(VoxelMap, MayBeEmpty) {
  VoxelMap map(0.5);
  EXPECT_TRUE(map.Cloud(SE3d()).empty());
  map.RemoveBefore(5);
  map.RemoveBeyond(Vec3::Zero(), 0);
  EXPECT_EQ(map.size(), 0U);
}

// 300 km away a float is rounded to 3 cm; seen from there, the points are where they were.
TEST(VoxelMap, KeepsItsPrecisionFarFromTheOrigin) {
  const SE3d far = SE3d::Exp((Vec6() << 0.1, -0.2, 2, 3e5, -2e5, 100).finished());
  const PointCloud scan = testing_support::Room(2000, 1);
  VoxelMap map(0.5);
  map.Insert(scan, far, 0);
  const PointCloud seen = map.Cloud(far.Inverse());
  std::map<std::array<float, 3>, int> points;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    points[{scan.x[i], scan.y[i], scan.z[i]}] = 0;
  }
  std::size_t exact = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    exact += points.count({seen.x[i], seen.y[i], seen.z[i]});
    double nearest = 1;
    for (std::size_t k = 0; k < scan.size(); ++k) {
      nearest = std::min(nearest, (seen.Point(i) - scan.Point(k)).norm());
    }
    EXPECT_LT(nearest, 1e-6);
  }
  EXPECT_GT(exact, seen.size() / 2);
}

TEST(VoxelMap, RefusesPointsBeyondItsLattice) {
  VoxelMap map(1e-3);  // 2^20 voxels are 1048.576 m.
  map.Insert(Cloud({{1048, 0, 0}, {-1048, 0, 0}}), SE3d(), 0);
  EXPECT_THAT(MessageOf([&] {
                map.Insert(Cloud({{10, 0, 0}}), Forward(1040), 1);
              }),
              HasSubstr("coordinate 1050 m in the map's frame; expected it within 2^20 voxels"));
}

// The rules over again, with a std::map from voxel to point, over a random drive that comes back.
TEST(VoxelMap, EqualsAMapOfItsRules) {
  constexpr double kVoxel = 0.7, kRadius = 9;
  struct Entry {
    Vec3 p, n;
    int scan, order;
  };
  std::map<std::array<int, 3>, Entry> expected;
  VoxelMap map(kVoxel);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int order = 0;
  for (int scan = 0; scan < 30; ++scan) {
    Vec6 xi;
    xi << 0.3 * unit(engine), 0.3 * unit(engine), 3 * unit(engine), 8 * std::sin(scan * 0.4),
        unit(engine), unit(engine);
    const SE3d T = SE3d::Exp(xi);
    PointCloud cloud;
    for (int i = 0; i < 400; ++i) {
      AddPoint(6 * Vec3(unit(engine), unit(engine), unit(engine)), &cloud);
      const Vec3 n = Vec3(unit(engine), unit(engine), unit(engine)).normalized();
      cloud.nx.push_back(static_cast<float>(n.x()));
      cloud.ny.push_back(static_cast<float>(n.y()));
      cloud.nz.push_back(static_cast<float>(n.z()));
    }
    map.RemoveBeyond(T.t(), kRadius);
    map.RemoveBefore(scan - 5);
    map.Insert(cloud, T, scan);
    for (auto entry = expected.begin(); entry != expected.end();) {
      const bool goes = (entry->second.p - T.t()).norm() > kRadius || entry->second.scan < scan - 5;
      entry = goes ? expected.erase(entry) : std::next(entry);
    }
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vec3 p = T * cloud.Point(i);
      std::array<int, 3> voxel;
      for (int axis = 0; axis < 3; ++axis) {
        voxel[static_cast<std::size_t>(axis)] =
            static_cast<int>(std::floor(static_cast<double>(static_cast<float>(p[axis])) / kVoxel));
      }
      expected.emplace(voxel, Entry{p, T.R() * cloud.Normal(i), scan, order++});
    }
    std::map<int, Entry> by_order;
    for (const auto& [voxel, entry] : expected) {
      by_order.emplace(entry.order, entry);
    }
    const SE3d T_other_map = SE3d::Exp((Vec6() << 0.1, 0.2, 1, 5, -3, scan).finished());
    const PointCloud seen = map.Cloud(T_other_map);
    ASSERT_EQ(seen.size(), expected.size()) << scan;
    ASSERT_EQ(map.size(), expected.size());
    std::size_t i = 0;
    for (const auto& [unused, entry] : by_order) {
      EXPECT_LT((seen.Point(i) - T_other_map * entry.p).norm(), 1e-5);
      EXPECT_LT((seen.Normal(i) - T_other_map.R() * entry.n).norm(), 1e-6);
      ++i;
    }
  }
}

}  // namespace
}  // namespace icpscape
