// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/origin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::ElementsAre;

PointCloud CloudAt(double x, double y, double z) {
  PointCloud cloud;
  for (const double step : {-3.0, -0.5, 0.0, 2.0, 30.0}) {
    testing_support::AddPoint({x + step, y - step, z}, &cloud);
  }
  return cloud;
}

TEST(Origin, IsTheMiddleOfWhatLiesFarOut) {
  const std::vector<double> near = {-900, 1, 999}, at = {1000, 1000, 1000};
  EXPECT_EQ(OriginOf(near, near, at), Vec3(0, 0, 0));
  // One coordinate that is far out moves nothing, half of them do.
  EXPECT_EQ(OriginOf({1, 2, 1e8}, near, near), Vec3(0, 0, 0));
  EXPECT_EQ(OriginOf({1, 1000.6, 1e8}, near, {7.4, 7.4, 7.4}), Vec3(1001, 1, 7));
  EXPECT_EQ(OriginOf({-5e6, -5e6, 0}, near, near), Vec3(-5e6, 1, 1));
}

TEST(Origin, IsTakenOutOnce) {
  PointCloud cloud = CloudAt(400000, -2000, 100);
  TakeOutOrigin(&cloud);
  EXPECT_EQ(cloud.origin, Vec3(400000, -2000, 100));
  EXPECT_THAT(cloud.x, ElementsAre(-3, -0.5, 0, 2, 30));
  EXPECT_THAT(cloud.y, ElementsAre(3, 0.5, 0, -2, -30));
  EXPECT_THAT(cloud.z, ElementsAre(0, 0, 0, 0, 0));
  EXPECT_EQ(cloud.sensor, Vec3(0, 0, 0));  // Nobody knew it.
  PointCloud again = cloud;
  again.x.assign(5, 5000);
  TakeOutOrigin(&again);
  EXPECT_EQ(again.origin, cloud.origin);
  PointCloud known = CloudAt(400000, 0, 0);
  known.sensor = {400001, 2, 3};
  TakeOutOrigin(&known);
  EXPECT_EQ(known.sensor, Vec3(1, 2, 3));
  PointCloud near = CloudAt(900, 0, 0);
  TakeOutOrigin(&near);
  EXPECT_EQ(near.origin, Vec3(0, 0, 0));
  EXPECT_EQ(near.x[0], 897);
}

TEST(Origin, IsSharedWhereThatIsNear) {
  const auto origins = [](PointCloud source, PointCloud target) {
    TakeOutOrigin(&source);
    TakeOutOrigin(&target);
    ShareOrigin(&source, &target);
    return std::make_pair(source, target);
  };
  const auto [source, target] = origins(CloudAt(5000, 0, 0), CloudAt(5900, 8, 0));
  EXPECT_EQ(source.origin, Vec3(5900, 8, 0));
  EXPECT_EQ(target.origin, Vec3(5900, 8, 0));
  EXPECT_THAT(source.x, ElementsAre(-903, -900.5, -900, -898, -870));
  EXPECT_EQ(source.sensor, Vec3(-900, -8, 0));
  // A target just within the limit takes the origin of a source just beyond.
  const auto [beyond, within] = origins(CloudAt(1100, 0, 0), CloudAt(900, 0, 0));
  EXPECT_EQ(beyond.origin, Vec3(1100, 0, 0));
  EXPECT_EQ(within.origin, Vec3(1100, 0, 0));
  EXPECT_EQ(within.x[2], -200);
  // A scan in the frame of its sensor, and a map.
  const auto [scan, map] = origins(CloudAt(0, 0, 0), CloudAt(458000, 5429000, 0));
  EXPECT_EQ(scan.origin, Vec3(0, 0, 0));
  EXPECT_EQ(map.origin, Vec3(458000, 5429000, 0));
}

TEST(Origin, PointsFarFromTheOthersAreDropped) {
  PointCloud cloud;
  cloud.x = {1, 2, 1.1e6F, 3, 4};
  cloud.y = {0, 0, 0, -1.1e6F, 0.9e6F};
  cloud.z = {0, 1, 0, 0, 0};
  EXPECT_EQ(DropStrays(&cloud), 2U);
  EXPECT_EQ(cloud.x, (std::vector<float>{1, 2, 4}));
  EXPECT_EQ(DropStrays(&cloud), 0U);
}

// By the definition: p_user = origin + p in either frame.
TEST(Origin, PosesGoToTheUserAndBack) {
  const PairOrigins origins = {{1000, -5000, 3}, {458000, 5429000, 100}};
  const SE3d T = SE3d::Exp((Vec6() << 0.3, -0.2, 1.1, 4, 5, 6).finished());
  const SE3d T_user = origins.ToUser(T);
  const Vec3 p(7, -8, 9);
  EXPECT_LE((T_user * (origins.source + p) - (origins.target + T * p)).norm(), 1e-8);
  EXPECT_LE((origins.FromUser(T_user).Matrix() - T.Matrix()).norm(), 1e-8);
  // Without origins not a bit changes.
  const SE3d minus_zero(Mat3::Identity(), Vec3(-0.0, 1, 2));
  EXPECT_TRUE(std::signbit(PairOrigins().ToUser(minus_zero).t().x()));
}

}  // namespace
}  // namespace icpscape
