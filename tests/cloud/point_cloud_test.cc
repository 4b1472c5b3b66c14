// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/point_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace icpscape {
namespace {

using testing::ElementsAre;

PointCloud FarCloud() {
  PointCloud cloud;
  cloud.x = {1, 2, 3};
  cloud.y = {0, 0, 5};
  cloud.z = {0, 1, 0};
  cloud.time_s = {0.01F, 0.02F, 0.03F};
  cloud.sensor = {1, 0, 2};
  cloud.origin = {458000, 5429000, 100};
  return cloud;
}

TEST(PointCloud, SelectKeepsTimesSensorAndOrigin) {
  const PointCloud part = FarCloud().Select({1, 0, 1});
  EXPECT_THAT(part.x, ElementsAre(1, 3));
  EXPECT_THAT(part.time_s, ElementsAre(0.01F, 0.03F));
  EXPECT_EQ(part.sensor, Vec3(1, 0, 2));
  EXPECT_EQ(part.origin, Vec3(458000, 5429000, 100));
}

TEST(PointCloud, TheSensorMovesWithThePoints) {
  Mat3 quarter;  // About z: x becomes y.
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const PointCloud moved = FarCloud().Transformed(SE3d(quarter, Vec3(10, 20, 30)));
  EXPECT_THAT(moved.x, ElementsAre(10, 10, 5));
  EXPECT_THAT(moved.y, ElementsAre(21, 22, 23));
  EXPECT_EQ(moved.sensor, Vec3(10, 21, 32));
  EXPECT_EQ(moved.origin, Vec3(458000, 5429000, 100));
}

}  // namespace
}  // namespace icpscape
