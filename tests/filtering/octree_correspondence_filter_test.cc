// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/octree_correspondence_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/octree/octree_pointcloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "icpscape/common/error.h"
#include "icpscape/filtering/filter_statistics.h"
#include "icpscape/io/sequences.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

struct Masks {
  std::vector<char> source, target;
};

// Alg. 1 by the book: a set of the voxels of each cloud, and a look-up of each point in the other.
Masks BruteForce(const PointCloud& source, const PointCloud& target, const SE3d& T, double voxel) {
  using Voxel = std::array<long long, 3>;
  const auto voxel_of = [&](const PointCloud& cloud, std::size_t i) {
    return Voxel{std::llround(std::floor(cloud.x[i] / voxel)),
                 std::llround(std::floor(cloud.y[i] / voxel)),
                 std::llround(std::floor(cloud.z[i] / voxel))};
  };
  const PointCloud moved = source.Transformed(T);
  std::set<Voxel> in_source, in_target;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    in_source.insert(voxel_of(moved, i));
  }
  for (std::size_t j = 0; j < target.size(); ++j) {
    in_target.insert(voxel_of(target, j));
  }
  Masks masks;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    masks.source.push_back(static_cast<char>(in_target.count(voxel_of(moved, i))));
  }
  for (std::size_t j = 0; j < target.size(); ++j) {
    masks.target.push_back(static_cast<char>(in_source.count(voxel_of(target, j))));
  }
  return masks;
}

// The same on two of PCL's octrees. PCL fits the box to the data and takes keys from its corner, so
// the box is given: 2^16 voxels about the origin, which is then a corner of the lattice.
class PclOctree {
 public:
  PclOctree(const PointCloud& cloud, double voxel) : octree_(voxel) {
    points_.reset(new pcl::PointCloud<pcl::PointXYZ>);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      points_->push_back({cloud.x[i], cloud.y[i], cloud.z[i]});
    }
    const double half = 32768 * voxel;
    octree_.defineBoundingBox(-half, -half, -half, half, half, half);
    octree_.setInputCloud(points_);
    octree_.addPointsFromInputCloud();
  }
  std::vector<char> OccupiedAt(const PclOctree& other) const {
    std::vector<char> occupied;
    for (const pcl::PointXYZ& point : *other.points_) {
      occupied.push_back(octree_.isVoxelOccupiedAtPoint(point) ? 1 : 0);
    }
    return occupied;
  }

 private:
  pcl::PointCloud<pcl::PointXYZ>::Ptr points_;
  pcl::octree::OctreePointCloud<pcl::PointXYZ> octree_;
};

Masks ByPcl(const PointCloud& source, const PointCloud& target, const SE3d& T, double voxel) {
  const PclOctree moved(source.Transformed(T), voxel);
  const PclOctree still(target, voxel);
  return {still.OccupiedAt(moved), moved.OccupiedAt(still)};
}

PointCloud Random(unsigned seed, std::size_t size, double extent_m) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-extent_m, extent_m);
  PointCloud cloud;
  for (std::size_t i = 0; i < size; ++i) {
    cloud.x.push_back(static_cast<float>(uniform(random)));
    cloud.y.push_back(static_cast<float>(uniform(random)));
    cloud.z.push_back(static_cast<float>(uniform(random) / 10));
    cloud.label.push_back(static_cast<std::int32_t>(i));
  }
  return cloud;
}

SE3d SomeMotion() {
  Vec6 xi;
  xi << 0.01, -0.02, 0.1, 0.8, 0.05, -0.03;
  return SE3d::Exp(xi);
}

TEST(OctreeCorrespondenceFilter, EqualsBruteForceAndPclsOctree) {
  const PointCloud source = Random(1, 20000, 8), target = Random(2, 20000, 8);
  for (const double voxel : {0.1, 0.125, 0.5, 0.77}) {
    const KeptPoints kept = OctreeCorrespondenceFilter(source, target, SomeMotion(), {voxel});
    const Masks brute = BruteForce(source, target, SomeMotion(), voxel);
    const Masks pcl = ByPcl(source, target, SomeMotion(), voxel);
    EXPECT_EQ(kept.source, brute.source);
    EXPECT_EQ(kept.target, brute.target);
    EXPECT_EQ(kept.source, pcl.source);
    EXPECT_EQ(kept.target, pcl.target);
    EXPECT_GT(CountKept(kept.source).kept, 100U);
    EXPECT_LT(CountKept(kept.source).kept, source.size());
  }
}

TEST(OctreeCorrespondenceFilter, EqualsPclsOctreeOnVoxelBordersWhereTheLatticeIsExact) {
  // With a voxel of 2^-3 m every border is a float. With 0.1 m PCL's keys, taken from a corner
  // kilometres away, can round a point on a border (0.5 m) to the other side; between borders,
  // where measured points lie, they agree.
  PointCloud source, target;
  for (int k = -40; k <= 40; ++k) {
    for (PointCloud* cloud : {&source, &target}) {
      const float c = 0.125F * static_cast<float>(k) * (cloud == &source ? 1.F : 3.F);
      cloud->x.push_back(c), cloud->y.push_back(-c), cloud->z.push_back(2 * c);
    }
  }
  const KeptPoints kept = OctreeCorrespondenceFilter(source, target, SE3d(), {0.125});
  const Masks pcl = ByPcl(source, target, SE3d(), 0.125);
  EXPECT_EQ(kept.source, pcl.source);
  EXPECT_EQ(kept.target, pcl.target);
  EXPECT_EQ(CountKept(kept.source).kept, 27U);
}

TEST(OctreeCorrespondenceFilter, RemovesNothingMoreTheSecondTime) {
  const PointCloud source = Random(3, 3000, 4), target = Random(4, 3000, 4);
  const KeptPoints kept = OctreeCorrespondenceFilter(source, target, SomeMotion(), {0.5});
  const PointCloud left = source.Select(kept.source);
  ASSERT_GT(left.size(), 0U);
  const KeptPoints again =
      OctreeCorrespondenceFilter(left, target.Select(kept.target), SomeMotion(), {0.5});
  EXPECT_EQ(CountKept(again.source).kept, left.size());
  EXPECT_EQ(CountKept(again.target).kept, CountKept(kept.target).kept);
}

// A wall of 2 cm sampling, 1 m by 1 m, in the plane x = const (across) or y = const (along).
PointCloud Wall(double offset_m, bool across) {
  PointCloud cloud;
  for (int a = 0; a < 50; ++a) {
    for (int b = 0; b < 50; ++b) {
      const auto along = static_cast<float>(5.01 + 0.02 * a);
      const auto fixed = static_cast<float>(offset_m);
      cloud.x.push_back(across ? fixed : along);
      cloud.y.push_back(across ? along : fixed);
      cloud.z.push_back(static_cast<float>(0.01 + 0.02 * b));
    }
  }
  return cloud;
}

TEST(OctreeCorrespondenceFilter, HoldsTheBrakingArgument) {
  const double worst_m = 0.5 * 10 * 0.1 * 0.1;  // Braking at 10 m/s^2 for one turn of 0.1 s.
  EXPECT_LT(worst_m, OctreeFilterOptions().voxel_size_m);
  const SE3d braked(Mat3::Identity(), Vec3(worst_m, 0, 0));
  const SE3d half_metre(Mat3::Identity(), Vec3(0.5, 0, 0));
  // Along the motion the offset costs less than one voxel of the wall's length.
  const PointCloud along = Wall(3.05, false);
  const double kept =
      CountKept(OctreeCorrespondenceFilter(along, along, braked, {}).source).Fraction();
  EXPECT_GT(kept, 0.9);
  // Across it, half of all walls stay in their voxel: the bound on the misalignment does not keep
  // every static surface. At five voxels none stays.
  int walls_kept = 0;
  for (int k = 0; k < 100; ++k) {
    const PointCloud wall = Wall(8.0005 + 0.001 * k, true);
    walls_kept += CountKept(OctreeCorrespondenceFilter(wall, wall, braked, {}).source).kept > 0;
    EXPECT_EQ(CountKept(OctreeCorrespondenceFilter(wall, wall, half_metre, {}).source).kept, 0U);
  }
  EXPECT_EQ(walls_kept, 50);
}

TEST(OctreeCorrespondenceFilter, RefusesWhatCannotBe) {
  PointCloud cloud = Random(5, 10, 5);
  EXPECT_THROW(OctreeCorrespondenceFilter(cloud, cloud, SE3d(), {0}), UsageError);
  EXPECT_THROW(OctreeCorrespondenceFilter(cloud, cloud, SE3d(), {std::nan("")}), UsageError);
  EXPECT_THROW(OctreeCorrespondenceFilter(cloud, cloud, SE3d(), {1e-7}), InputError);
  const KeptPoints nothing = OctreeCorrespondenceFilter(PointCloud(), cloud, SE3d(), {});
  EXPECT_TRUE(nothing.source.empty());
  EXPECT_EQ(CountKept(nothing.target).kept, 0U);
  EXPECT_EQ(CountKept(OctreeCorrespondenceFilter(cloud, PointCloud(), SE3d(), {}).source).kept, 0U);
}

TEST(OctreeCorrespondenceFilter, EqualsPclsOctreeOnARealPair) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const PointCloud source = KittiScan("00", 15), target = KittiScan("00", 14);
  const SE3d T = *OpenKittiSequence(KittiRoot(), "00").Motion(13, 14);  // The motion before.
  const KeptPoints kept = OctreeCorrespondenceFilter(source, target, T, {});
  const Masks brute = BruteForce(source, target, T, 0.1);
  EXPECT_EQ(kept.source, brute.source);
  EXPECT_EQ(kept.target, brute.target);
  const Masks pcl = ByPcl(source, target, T, 0.1);
  EXPECT_EQ(kept.source, pcl.source);
  EXPECT_EQ(kept.target, pcl.target);
  // Half of the points are left, and hardly any static one far out, where the rings lie further
  // apart than a voxel is long.
  EXPECT_NEAR(CountKept(kept.source).Fraction(), 0.507, 0.001);
  EXPECT_NEAR(CountKept(kept.target).Fraction(), 0.500, 0.001);
  const std::vector<RangeBin> bins = KeptByRange(source, kept.source, 10);
  EXPECT_NEAR(bins[0].count.Fraction(), 0.616, 0.001);
  EXPECT_NEAR(bins[1].count.Fraction(), 0.497, 0.001);
  EXPECT_NEAR(bins[3].count.Fraction(), 0.068, 0.001);
}

}  // namespace
}  // namespace icpscape
