// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/preparation/elevation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icpscape {
namespace {

TEST(CorrectElevation, TurnsAboutTheHorizontalAxis) {
  PointCloud cloud;
  cloud.x = {10, 0};
  cloud.y = {0, 5};
  cloud.z = {0, 5};
  CorrectElevation(1, &cloud);
  // The first point rises by 1 degree on a circle of 10 m; the second from 45 to 46 degrees.
  EXPECT_NEAR(cloud.x[0], 10 * std::cos(M_PI / 180), 1e-6);
  EXPECT_NEAR(cloud.z[0], 10 * std::sin(M_PI / 180), 1e-6);
  EXPECT_NEAR(cloud.y[1], std::sqrt(50) * std::cos(46 * M_PI / 180), 1e-6);
  EXPECT_NEAR(cloud.z[1], std::sqrt(50) * std::sin(46 * M_PI / 180), 1e-6);
}

// The same two points about a sensor elsewhere.
TEST(CorrectElevation, TurnsAboutTheSensor) {
  PointCloud cloud;
  cloud.sensor = {100, -50, 20};
  cloud.x = {110, 100};
  cloud.y = {-50, -45};
  cloud.z = {20, 25};
  CorrectElevation(1, &cloud);
  EXPECT_NEAR(cloud.x[0], 100 + 10 * std::cos(M_PI / 180), 1e-5);
  EXPECT_NEAR(cloud.z[0], 20 + 10 * std::sin(M_PI / 180), 1e-5);
  EXPECT_NEAR(cloud.y[1], -50 + std::sqrt(50) * std::cos(46 * M_PI / 180), 1e-5);
  EXPECT_NEAR(cloud.z[1], 20 + std::sqrt(50) * std::sin(46 * M_PI / 180), 1e-5);
}

}  // namespace
}  // namespace icpscape
