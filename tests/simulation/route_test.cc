// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/route.h"

#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/common/vehicle.h"
#include "icpscape/simulation/lidar.h"

namespace icpscape {
namespace {

// What the poses of the lidar, ten per second, say about the car.
TEST(TownRoute, IsDrivenAsACarDrives) {
  const std::vector<SE3d> poses = TownRoute();
  const SE3d T_lidar_axle(Mat3::Identity(), Vec3(-kSensorAheadOfRearAxle_m, 0, -kLidarHeightM));
  double length_m = 0, speed_before = 0, right_rad = 0, left_rad = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const SE3d before = poses[i - 1] * T_lidar_axle, now = poses[i] * T_lidar_axle;
    const Vec6 twist = (before.Inverse() * now).Log() / 0.1;
    EXPECT_LT(std::abs(twist[4]), 0.05) << "side slip at " << i;  // Between straight and arc.
    EXPECT_NEAR(now.t().z(), 0, 1e-12);
    EXPECT_NEAR(twist.head<2>().norm(), 0, 1e-12);
    const double speed = twist[3];
    EXPECT_LE(speed, 10.2);
    // Poses are a centimetre apart: so is the speed a tenth of a metre a second.
    EXPECT_LE(std::abs(speed - speed_before) / 0.1, 2 + 2 * 0.1 / 0.1) << i;
    EXPECT_LE(std::abs(twist[2] * speed), 4.1 * 4.1 / 9 * 1.1) << "across, m/s^2";
    (twist[2] > 0 ? left_rad : right_rad) += 0.1 * std::abs(twist[2]);
    length_m += 0.1 * speed;
    speed_before = speed;
  }
  EXPECT_NEAR(length_m, 200 + 2 * 9 * M_PI / 2, 0.2);
  EXPECT_NEAR(right_rad, M_PI / 2, 0.01);
  EXPECT_NEAR(left_rad, M_PI / 2, 0.01);
  EXPECT_LT(speed_before, 0.3);
  EXPECT_GT(poses.size(), 300U);
  EXPECT_LT(poses.size(), 400U);
}

}  // namespace
}  // namespace icpscape
