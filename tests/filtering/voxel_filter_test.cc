// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/voxel_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

#include "icpscape/common/error.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::ElementsAre;

using Voxel = std::array<long, 3>;  // Its indices along z, y and x: compared as PCL counts voxels.

Voxel VoxelOf(const PointCloud& cloud, std::size_t i, double voxel) {
  return {std::lround(std::floor(cloud.z[i] / voxel)), std::lround(std::floor(cloud.y[i] / voxel)),
          std::lround(std::floor(cloud.x[i] / voxel))};
}

// Dense near the origin, sparse far out, with negative coordinates and an intensity each.
PointCloud Random(unsigned seed, std::size_t size, double extent_m) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, extent_m);
  PointCloud cloud;
  for (std::size_t i = 0; i < size; ++i) {
    testing_support::AddPoint(Vec3(normal(random), normal(random), normal(random) / 10), &cloud);
    cloud.intensity.push_back(static_cast<float>(i % 256) / 255);
  }
  return cloud;
}

// PCL's centroids, sorted by z, y and x index. PCL multiplies by the inverse of the voxel's size in
// float: for powers of two the lattice is ours.
pcl::PointCloud<pcl::PointXYZI> ByPcl(const PointCloud& cloud, float voxel) {
  pcl::PointCloud<pcl::PointXYZI>::Ptr points(new pcl::PointCloud<pcl::PointXYZI>);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    pcl::PointXYZI point;
    point.x = cloud.x[i], point.y = cloud.y[i], point.z = cloud.z[i];
    point.intensity = cloud.intensity[i];
    points->push_back(point);
  }
  pcl::VoxelGrid<pcl::PointXYZI> grid;
  grid.setInputCloud(points);
  grid.setLeafSize(voxel, voxel, voxel);
  pcl::PointCloud<pcl::PointXYZI> out;
  grid.filter(out);
  return out;
}

void ExpectPcls(const PointCloud& cloud, float voxel) {
  const PointCloud ours = VoxelFilter(cloud, voxel);
  const pcl::PointCloud<pcl::PointXYZI> pcls = ByPcl(cloud, voxel);
  ASSERT_EQ(ours.size(), pcls.size());
  std::vector<std::size_t> order(ours.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return VoxelOf(ours, a, voxel) < VoxelOf(ours, b, voxel);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const pcl::PointXYZI& expected = pcls[i];
    ASSERT_NEAR(ours.x[order[i]], expected.x, 1e-4);
    ASSERT_NEAR(ours.y[order[i]], expected.y, 1e-4);
    ASSERT_NEAR(ours.z[order[i]], expected.z, 1e-4);
    ASSERT_NEAR(ours.intensity[order[i]], expected.intensity, 1e-4);
  }
}

// The definition, on a map: centroids and the order of first points.
void ExpectCentroids(const PointCloud& cloud, double voxel) {
  struct Sums {
    std::size_t place;
    double x, y, z, intensity, points;
  };
  std::map<Voxel, Sums> voxels;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Sums& sum = voxels.try_emplace(VoxelOf(cloud, i, voxel), Sums{voxels.size(), 0, 0, 0, 0, 0})
                    .first->second;
    sum.x += cloud.x[i], sum.y += cloud.y[i], sum.z += cloud.z[i];
    sum.intensity += cloud.intensity[i], sum.points += 1;
  }
  const PointCloud out = VoxelFilter(cloud, voxel);
  ASSERT_EQ(out.size(), voxels.size());
  ASSERT_EQ(out.intensity.size(), voxels.size());
  for (const auto& [key, sum] : voxels) {
    ASSERT_EQ(out.x[sum.place], static_cast<float>(sum.x / sum.points));
    ASSERT_EQ(out.y[sum.place], static_cast<float>(sum.y / sum.points));
    ASSERT_EQ(out.z[sum.place], static_cast<float>(sum.z / sum.points));
    ASSERT_EQ(out.intensity[sum.place], static_cast<float>(sum.intensity / sum.points));
    ASSERT_EQ(VoxelOf(out, sum.place, voxel), key);
  }
}

void ExpectEqual(const PointCloud& a, const PointCloud& b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
  EXPECT_EQ(a.intensity, b.intensity);
}

TEST(VoxelFilter, AveragesByHand) {
  PointCloud cloud;
  cloud.x = {0.75F, -0.25F, 0.5F, 0.5F, -0.5F, 0.25F};
  cloud.y = {0.F, 0.25F, 0.25F, 0.F, 0.F, 0.25F};
  cloud.z = {0.F, -0.5F, 0.F, 0.25F, -0.25F, 0.F};
  cloud.intensity = {1, 2, 4, 4, 0, 7};
  // Voxels of half a metre: 0.5 is in the second, -0.5 in the first below zero.
  const PointCloud out = VoxelFilter(cloud, 0.5);
  EXPECT_THAT(out.x, ElementsAre(1.75F / 3, -0.375F, 0.25F));
  EXPECT_THAT(out.y, ElementsAre(0.25F / 3, 0.125F, 0.25F));
  EXPECT_THAT(out.z, ElementsAre(0.25F / 3, -0.375F, 0.F));
  EXPECT_THAT(out.intensity, ElementsAre(3, 1, 7));
}

TEST(VoxelFilter, EqualsItsDefinition) {
  const PointCloud cloud = Random(1, 20000, 5);
  for (const double voxel : {0.1, 0.25, 0.77, 100.}) {
    ExpectCentroids(cloud, voxel);
  }
}

TEST(VoxelFilter, EqualsPclsVoxelGridWhereTheLatticeIsTheSame) {
  const PointCloud cloud = Random(2, 50000, 10);
  for (const float voxel : {0.125F, 0.25F, 0.5F, 2.F}) {
    ExpectPcls(cloud, voxel);
  }
  PointCloud borders;  // Every point is on a border.
  for (int k = -300; k <= 300; ++k) {
    testing_support::AddPoint(0.125 * Vec3(k, -k, k / 3), &borders);
    borders.intensity.push_back(0);
  }
  ExpectPcls(borders, 0.25);
  EXPECT_EQ(VoxelFilter(borders, 0.125).size(), borders.size());
}

TEST(VoxelFilter, ChangesNothingTheSecondTime) {
  const PointCloud cloud = Random(3, 20000, 3);
  for (const double voxel : {0.1, 0.3, 0.5}) {
    const PointCloud once = VoxelFilter(cloud, voxel);
    EXPECT_LT(once.size(), cloud.size());
    ExpectEqual(VoxelFilter(once, voxel), once);
  }
  // Nor where every point has a voxel of its own.
  ExpectEqual(VoxelFilter(cloud, 1e-4), cloud);
}

TEST(VoxelFilter, LeavesOutWhatHasNoAverage) {
  PointCloud cloud = Random(5, 100, 1);
  cloud.nx = cloud.ny = cloud.nz = std::vector<float>(100, 0.577F);
  cloud.ring = cloud.label = std::vector<std::int32_t>(100, 3);
  const PointCloud out = VoxelFilter(cloud, 0.5);
  EXPECT_EQ(out.intensity.size(), out.size());
  EXPECT_TRUE(out.nx.empty() && out.ny.empty() && out.nz.empty());
  EXPECT_TRUE(out.ring.empty() && out.label.empty());
  cloud.intensity.clear();
  EXPECT_TRUE(VoxelFilter(cloud, 0.5).intensity.empty());
  EXPECT_EQ(VoxelFilter(cloud, 0.5).x, out.x);
}

TEST(VoxelFilter, RefusesWhatCannotBe) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PointCloud cloud = Random(6, 10, 5);
  for (const double voxel : {0., -0.25, std::nan(""), kInfinity}) {
    EXPECT_THROW(VoxelFilter(cloud, voxel), UsageError);
    EXPECT_THROW(VoxelFilter(PointCloud(), voxel), UsageError);
  }
  EXPECT_THROW(VoxelFilter(cloud, 1e-7), InputError);
  EXPECT_TRUE(VoxelFilter(PointCloud(), 0.25).empty());
  for (const double c : {std::nan(""), kInfinity, -kInfinity}) {
    cloud.y[3] = static_cast<float>(c);
    EXPECT_THROW(VoxelFilter(cloud, 0.25), InputError);
  }
}

TEST(VoxelFilter, EqualsPclsVoxelGridOnARealScan) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const PointCloud scan = KittiScan("00", 95);
  ExpectCentroids(scan, 0.1);
  for (const float voxel : {0.25F, 0.5F}) {
    ExpectPcls(scan, voxel);
  }
  EXPECT_EQ(VoxelFilter(scan, 0.25).size(), 21662U);
}

}  // namespace
}  // namespace icpscape
