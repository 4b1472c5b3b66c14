// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/ego_blind_spot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

PointCloud Along(const std::vector<Vec3>& points) {
  PointCloud cloud;
  for (const Vec3& p : points) {
    cloud.x.push_back(static_cast<float>(p.x()));
    cloud.y.push_back(static_cast<float>(p.y()));
    cloud.z.push_back(static_cast<float>(p.z()));
    cloud.label.push_back(static_cast<std::int32_t>(cloud.label.size()));
  }
  return cloud;
}

TEST(ArtificialBlindSpots, IsACylinderWithItsBorder) {
  const PointCloud cloud =
      Along({{5, 0, 0}, {5.001, 0, 0}, {3, 4, 100}, {3, -4.01, -2}, {0, 0, -1.7}});
  EXPECT_THAT(ArtificialBlindSpots(cloud, cloud, 5).source, testing::ElementsAre(0, 1, 0, 1, 0));
  EXPECT_THROW(ArtificialBlindSpots(cloud, cloud, 0), UsageError);
  EXPECT_THROW(ArtificialBlindSpots(cloud, cloud, std::nan("")), UsageError);
}

TEST(EgoBlindSpotFilter, DropsWhatTheOtherSensorCannotSee) {
  // The vehicle drives 2 m ahead and turns left by 90 degrees. In the target frame the source's
  // sensor is at (2, 0); in the source frame the target's is at R^T (-t) = (0, 2).
  Mat3 R;
  R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const SE3d T(R, Vec3(2, 0, 0.3));
  const PointCloud target = Along({{7, 0, 0}, {7.01, 0, 0}, {-2.99, 0, 0}, {-3.01, 0, 0}});
  const PointCloud source =
      Along({{0, 7, 0}, {0, 7.01, 0}, {0, -2.99, 0}, {-3.01, 0, 0}, {-5, 2, 9}});
  const KeptPoints kept = EgoBlindSpotFilter(source, target, T, 5);
  EXPECT_THAT(kept.target, testing::ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(kept.source, testing::ElementsAre(0, 1, 0, 0, 0));
  EXPECT_THROW(EgoBlindSpotFilter(source, target, T, -1), UsageError);
}

// The same scans with each sensor away from the origin of its frame.
TEST(EgoBlindSpotFilter, IsAboutTheSensors) {
  Mat3 R;
  R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const SE3d T(R, Vec3(2, 0, 0.3));
  const SE3d source_shift(Mat3::Identity(), Vec3(30, -20, 1));
  const SE3d target_shift(Mat3::Identity(), Vec3(-7, 50, 2));
  const PointCloud target =
      Along({{7, 0, 0}, {7.01, 0, 0}, {-2.99, 0, 0}, {-3.01, 0, 0}}).Transformed(target_shift);
  const PointCloud source =
      Along({{0, 6.99, 0}, {0, 7.01, 0}, {0, -2.99, 0}, {-3.01, 0, 0}}).Transformed(source_shift);
  EXPECT_EQ(source.sensor, Vec3(30, -20, 1));
  const KeptPoints kept =
      EgoBlindSpotFilter(source, target, target_shift * T * source_shift.Inverse(), 5.001);
  EXPECT_THAT(kept.target, testing::ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(kept.source, testing::ElementsAre(0, 1, 0, 0));
  const KeptPoints own = ArtificialBlindSpots(source, target, 3);
  EXPECT_THAT(own.source, testing::ElementsAre(1, 1, 0, 1));
  EXPECT_THAT(own.target, testing::ElementsAre(1, 1, 0, 1));
}

TEST(EgoBlindSpotFilter, WithoutMotionIsTheArtificialBlindSpot) {
  std::vector<Vec3> points;
  for (int x = -8; x <= 8; ++x) {
    for (int y = -8; y <= 8; ++y) {
      points.emplace_back(x, y, -1.7);
    }
  }
  const PointCloud cloud = Along(points);
  const KeptPoints kept = EgoBlindSpotFilter(cloud, cloud, SE3d(), kEgoBlindSpotRadius_m);
  const std::vector<char> ring = ArtificialBlindSpots(cloud, cloud, kEgoBlindSpotRadius_m).source;
  EXPECT_EQ(kept.source, ring);
  EXPECT_EQ(kept.target, ring);
  EXPECT_EQ(std::count(ring.begin(), ring.end(), 1),
            17 * 17 - 81);  // 81 lattice points lie within a circle of radius 5.
}

TEST(EgoBlindSpotFilter, LeavesTheSameGroundToBothScans) {
  // Two scans of one flat ground, each blind within 5 m of itself: after the filter, exactly the
  // points that both scans hold are left.
  const SE3d T(Mat3::Identity(), Vec3(3, 0, 0));
  std::vector<Vec3> ground_target, ground_source;
  for (int x = -20; x <= 20; ++x) {
    for (int y = -20; y <= 20; ++y) {
      ground_target.emplace_back(x, y, -1.7);
      ground_source.emplace_back(x - 3, y, -1.7);
    }
  }
  const PointCloud all_target = Along(ground_target), all_source = Along(ground_source);
  const PointCloud target =
      all_target.Select(ArtificialBlindSpots(all_target, all_target, 5).source);
  const PointCloud source =
      all_source.Select(ArtificialBlindSpots(all_source, all_source, 5).source);
  EXPECT_NE(source.label, target.label);
  const KeptPoints kept = EgoBlindSpotFilter(source, target, T, 5);
  EXPECT_EQ(source.Select(kept.source).label, target.Select(kept.target).label);
}

}  // namespace
}  // namespace icpscape
