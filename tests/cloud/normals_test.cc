// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/normals.h"

#include <gtest/gtest.h>
#include <pcl/common/centroid.h>
#include <pcl/features/normal_3d.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "icpscape/io/kitti.h"
#include "icpscape/neighbors/neighbor_search.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing_support::AddPoint;

TEST(Normals, PlaneFacesTheSensor) {
  PointCloud cloud;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      AddPoint({0.1 * i, 0.1 * j, -1.7}, &cloud);  // A floor below the sensor.
    }
  }
  EXPECT_EQ(EstimateNormals({}, 1, &cloud), 0U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_LE((cloud.Normal(i) - Vec3::UnitZ()).norm(), 1e-6);
  }
}

TEST(Normals, NeighborhoodsWithoutAPlaneHaveNone) {
  PointCloud two;
  AddPoint({1, 0, 0}, &two);
  AddPoint({2, 0, 0}, &two);
  EXPECT_EQ(EstimateNormals({}, 1, &two), 2U);
  EXPECT_FALSE(two.NormalIsValid(0));

  PointCloud line;
  for (int i = 0; i < 50; ++i) {
    AddPoint({0.25 * i, 0, 1}, &line);
  }
  EXPECT_EQ(EstimateNormals({}, 1, &line), 50U);
  // Also where the points' coordinates round.
  PointCloud skew;
  for (int i = 0; i < 100; ++i) {
    AddPoint(i * Vec3(0.1, 0.07, 0.03) + Vec3(1, 2, 3), &skew);
  }
  EXPECT_EQ(EstimateNormals({}, 1, &skew), 100U);

  PointCloud equal;
  for (int i = 0; i < 50; ++i) {
    AddPoint({1, 2, 3}, &equal);
  }
  EXPECT_EQ(EstimateNormals({}, 1, &equal), 50U);

  // By radius: the lonely point has too few neighbours, the patch has enough.
  PointCloud patch;
  AddPoint({100, 0, 0}, &patch);
  for (int i = 0; i < 25; ++i) {
    AddPoint({0.1 * (i % 5), 0.1 * (i / 5), -1}, &patch);
  }
  NeighborhoodOptions radius;
  radius.radius_m = 0.3;
  EXPECT_EQ(EstimateNormals(radius, 1, &patch), 1U);
  EXPECT_FALSE(patch.NormalIsValid(0));
}

// Four points of 1 m by `thickness_m`: variances of 0.25 and 0.25 thickness^2. A line is one up to
// a ratio of 1e-7 of them, 0.316 mm.
TEST(Normals, OfALineThatIsThickEnough) {
  const auto without = [](double thickness_m) {
    PointCloud cloud;
    for (const double x : {0.0, 1.0}) {
      for (const double y : {0.0, thickness_m}) {
        AddPoint({x, y, 1}, &cloud);
      }
    }
    return EstimateNormals({4, 0}, 1, &cloud);
  };
  EXPECT_EQ(without(0.30e-3), 4U);
  EXPECT_EQ(without(0.33e-3), 0U);
  PointCloud three;  // A plane takes three points.
  for (const Vec3& p : {Vec3(1, 0, -1), Vec3(0, 1, -1), Vec3(0, 0, -1)}) {
    AddPoint(p, &three);
  }
  EXPECT_EQ(EstimateNormals({}, 1, &three), 0U);
}

TEST(Normals, CovarianceOfFourPointsByHand) {
  PointCloud cloud;
  for (const Vec3& p : {Vec3(1, 0, 5), Vec3(-1, 0, 5), Vec3(0, 2, 5), Vec3(0, -2, 5)}) {
    AddPoint(p, &cloud);
  }
  // Mean (0, 0, 5); sums of squares 2 and 8, divided by 4.
  const Mat3 expected = Vec3(0.5, 2, 0).asDiagonal();
  for (const Mat3& C : EstimateCovariances(cloud, {}, 1)) {
    EXPECT_LE((C - expected).norm(), 1e-15);
  }
}

// The default is the 20 nearest points, the point itself included.
TEST(Normals, CovarianceOfTheTwentyNearestByBruteForce) {
  const PointCloud cloud = testing_support::Room(60, 1);
  const std::vector<Mat3> covariances = EstimateCovariances(cloud, {}, 1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::vector<Vec3> nearest;
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      nearest.push_back(cloud.Point(j) - cloud.Point(i));
    }
    std::sort(nearest.begin(), nearest.end(),
              [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); });
    nearest.resize(20);
    Vec3 mean = Vec3::Zero();
    for (const Vec3& d : nearest) {
      mean += d / 20;
    }
    Mat3 expected = Mat3::Zero();
    for (const Vec3& d : nearest) {
      expected += (d - mean) * (d - mean).transpose() / 20;
    }
    EXPECT_LE((covariances[i] - expected).norm(), 1e-5 * expected.norm());
  }
}

TEST(Normals, SameBitsForAnyNumberOfThreads) {
  PointCloud one = testing_support::Room(5000, 1, SE3d(), 0.01);
  PointCloud three = one;
  EstimateNormals({}, 1, &one);
  EstimateNormals({}, 3, &three);
  EXPECT_EQ(one.nx, three.nx);
  EXPECT_EQ(one.ny, three.ny);
  EXPECT_EQ(one.nz, three.nz);
}

// A second method: PCL's estimator on the same neighbourhoods of a real scan.
TEST(Normals, AgreeWithPclOnARealScan) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::filesystem::path root = KittiRoot();
  DroppedPoints dropped;
  PointCloud cloud = ReadVelodyne(KittiFiles(root, "00").Scan(95), &dropped);
  EstimateNormals({}, 2, &cloud);
  const NeighborSearch search(cloud.View());
  const std::vector<Mat3> covariances = EstimateCovariances(cloud, {}, 2);
  int compared = 0;
  for (std::size_t i = 0; i < cloud.size(); i += 97) {
    std::vector<Neighbor> neighbors;
    search.KNearest({cloud.x[i], cloud.y[i], cloud.z[i]}, 20, &neighbors);
    pcl::PointCloud<pcl::PointXYZ> patch;  // About the point: PCL sums in float.
    for (const Neighbor& n : neighbors) {
      const Vec3 d = cloud.Point(static_cast<std::size_t>(n.index)) - cloud.Point(i);
      patch.emplace_back(static_cast<float>(d.x()), static_cast<float>(d.y()),
                         static_cast<float>(d.z()));
    }
    Eigen::Vector4f plane;
    float curvature = 0;
    ASSERT_TRUE(pcl::computePointNormal(patch, plane, curvature));
    const Vec3 eigenvalues = Eigen::SelfAdjointEigenSolver<Mat3>(covariances[i]).eigenvalues();
    // Where the two smaller eigenvalues are close the direction is ill-conditioned in float.
    if (eigenvalues[0] < 0.2 * eigenvalues[1] && eigenvalues[1] > 1e-3 * eigenvalues[2]) {
      const double cosine = std::abs(plane.head<3>().cast<double>().dot(cloud.Normal(i)));
      EXPECT_GT(cosine, 0.9999);
      ++compared;
    }
    EXPECT_LE(cloud.Normal(i).dot(cloud.Point(i)), 0);
  }
  EXPECT_GT(compared, 500);
}

TEST(PointCloud, SelectKeepsAllArraysInStep) {
  PointCloud cloud = testing_support::Room(50, 1);
  cloud.intensity.assign(50, 0);
  cloud.intensity[3] = 7;
  EstimateNormals({}, 1, &cloud);
  std::vector<char> keep(50, 0);
  keep[3] = keep[9] = 1;
  const PointCloud two = cloud.Select(keep);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two.x[1], cloud.x[9]);
  EXPECT_EQ(two.nz[1], cloud.nz[9]);
  EXPECT_EQ(two.intensity, (std::vector<float>{7, 0}));
}

TEST(PointCloud, DropsWhatNoRegistrationCanUse) {
  PointCloud cloud;
  AddPoint({1, 2, 3}, &cloud);
  AddPoint({0, 0, 0}, &cloud);
  AddPoint({NAN, 0, 1}, &cloud);
  AddPoint({0, INFINITY, 1}, &cloud);
  AddPoint({0, 0, 1}, &cloud);
  AddPoint({0, -1e9, 2}, &cloud);     // As far as any coordinate may be ...
  AddPoint({0, 0, -1.01e9}, &cloud);  // ... and beyond.
  const DroppedPoints dropped = DropInvalidPoints(&cloud);
  EXPECT_EQ(dropped.non_finite, 3U);
  EXPECT_EQ(dropped.zero, 1U);
  EXPECT_EQ(cloud.z, (std::vector<float>{3, 1, 2}));
}

}  // namespace
}  // namespace icpscape
