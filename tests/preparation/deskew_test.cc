// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/preparation/deskew.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "icpscape/common/error.h"
#include "icpscape/filtering/voxel_filter.h"
#include "icpscape/preparation/prepared_scan.h"
#include "icpscape/residuals/correspondence.h"
#include "tests/support/drives.h"
#include "tests/support/message_of.h"

namespace icpscape {
namespace {

using testing::FloatNear;
using testing::IsEmpty;
using testing::Pointwise;
using testing_support::MessageOf;

const Vec6 kVelocity = (Vec6() << 0.1, -0.2, 0.9, 12, 1.5, -0.3).finished();

PointCloud Points(const std::vector<float>& x, const std::vector<float>& time_s) {
  PointCloud cloud;
  cloud.x = x;
  cloud.y = cloud.z = std::vector<float>(x.size(), 0);
  cloud.time_s = time_s;
  return cloud;
}

// A lidar that drives towards a post at 10 m/s measures it nearer and nearer.
TEST(Deskew, BringsPointsToOneInstant) {
  PointCloud cloud = Points({5.5F, 5, 4.5F}, {-0.05F, 0, 0.05F});
  Deskew((Vec6() << 0, 0, 0, 10, 0, 0).finished(), 1, &cloud);
  EXPECT_THAT(cloud.x, Pointwise(FloatNear(1e-5F), {5.F, 5.F, 5.F}));
  EXPECT_THAT(cloud.time_s, IsEmpty());
  // One that turns to the left by 90 degrees a second sees what is ahead go to the right.
  cloud = Points({2, 2, 2}, {-1, 0, 1});
  cloud.nx = {0, 0, 0};
  cloud.ny = {1, 1, 1};
  cloud.nz = {0, 0, 0};
  Deskew((Vec6() << 0, 0, M_PI / 2, 0, 0, 0).finished(), 1, &cloud);
  EXPECT_THAT(cloud.x, Pointwise(FloatNear(1e-5F), {0.F, 2.F, 0.F}));
  EXPECT_THAT(cloud.y, Pointwise(FloatNear(1e-5F), {-2.F, 0.F, 2.F}));
  EXPECT_THAT(cloud.nx, Pointwise(FloatNear(1e-5F), {1.F, 0.F, -1.F}));
}

// Points of a world that stands still, each measured from the pose of its own time.
TEST(Deskew, UndoesTheMotion) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> metres(-40, 40), seconds(-0.05, 0.05);
  const SE3d T_world_lidar = SE3d::Exp((Vec6() << 0.3, 0.1, -2, 5, -7, 1).finished());
  PointCloud measured, expected;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 world(metres(random), metres(random), metres(random));
    const auto time_s = static_cast<float>(seconds(random));
    const Vec3 p = (T_world_lidar * SE3d::Exp(time_s * kVelocity)).Inverse() * world;
    const Vec3 q = T_world_lidar.Inverse() * world;
    for (const auto& [cloud, point] : {std::pair{&measured, p}, {&expected, q}}) {
      cloud->x.push_back(static_cast<float>(point.x()));
      cloud->y.push_back(static_cast<float>(point.y()));
      cloud->z.push_back(static_cast<float>(point.z()));
    }
    measured.time_s.push_back(time_s);
  }
  PointCloud one = measured, many = measured;
  Deskew(kVelocity, 1, &one);
  Deskew(kVelocity, 3, &many);
  EXPECT_EQ(one.x, many.x);
  EXPECT_EQ(one.z, many.z);
  double skew = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_LT((one.Point(i) - expected.Point(i)).norm(), 2e-5) << i;
    skew = std::max(skew, (measured.Point(i) - expected.Point(i)).norm());
  }
  EXPECT_GT(skew, 1);
}

TEST(Sweep, HasAnInstant) {
  const auto instant = [](const std::vector<float>& times) {
    return SweepOf(Points(std::vector<float>(times.size(), 1), times)).Instant_s();
  };
  EXPECT_EQ(instant({-0.25F, 0.5F, 0.125F}), 0);
  EXPECT_EQ(instant({0, 0.5F, 0.25F}), 0.25);
  EXPECT_EQ(instant({-0.5F, 0}), -0.25);
  EXPECT_EQ(instant({100, 100.5F}), 100.25);
  EXPECT_EQ(SweepOf(Points({1, 1, 1}, {0.25F, -0.5F, 0})).Duration_s(), 0.75);
}

TEST(Deskew, RefusesTimesThatAreNone) {
  for (const float time :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    PointCloud cloud = Points({1, 2}, {0, time});
    EXPECT_EQ(MessageOf<InputError>([&] { Deskew(kVelocity, 1, &cloud); }),
              "the time of a point is not finite; expected seconds.");
  }
}

// After the elevation, and before all that compares points.
TEST(Deskew, IsPartOfThePreparation) {
  PointCloud cloud = testing_support::TownDrive().scans[0];
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.time_s.push_back(static_cast<float>(std::atan2(cloud.y[i], cloud.x[i]) / 63));
  }
  PreparationOptions options;
  options.voxel_m = 0.4;
  PointCloud expected = cloud;
  Deskew(kVelocity, 1, &expected);
  expected = VoxelFilter(expected, 0.4);
  EXPECT_EQ(Prepare(cloud, 0, options, 2, kVelocity).cloud().x, expected.x);
  EXPECT_NE(Prepare(cloud, 0, options, 2).cloud().x, expected.x);
  // Rings are those of the file, by the azimuths of the lidar.
  cloud.ring.clear();
  const PreparedScan still = Prepare(cloud, kTargetLine, {}, 2);
  const PreparedScan moved = Prepare(cloud, kTargetLine, {}, 2, kVelocity);
  EXPECT_EQ(moved.cloud().ring, still.cloud().ring);
  EXPECT_NE(moved.cloud().x, still.cloud().x);
}

}  // namespace
}  // namespace icpscape
