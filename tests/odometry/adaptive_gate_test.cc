// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/adaptive_gate.h"

#include <gtest/gtest.h>

namespace icpscape {
namespace {

SE3d Motion(double yaw_rad, double x_m) {
  return SE3d(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()).toRotationMatrix(), Vec3(x_m, 0, 0));
}

TEST(AdaptiveGate, BeginsWithItsInitialError) {
  EXPECT_DOUBLE_EQ(AdaptiveGate(2).MaxDistance_m(), 6);
  EXPECT_DOUBLE_EQ(AdaptiveGate(0.5).MaxDistance_m(), 1.5);
}

// sigma^2 = (2^2 + 0.4^2 + 0.8^2) / 3 = 1.6 after errors of 0.4 and 0.8 m.
TEST(AdaptiveGate, IsThreeRootMeanSquares) {
  AdaptiveGate gate(2);
  gate.Add(Motion(0, 1), Motion(0, 1.4));
  EXPECT_NEAR(gate.MaxDistance_m(), 3 * std::sqrt(4.16 / 2), 1e-12);
  gate.Add(Motion(0, 1), Motion(0, 0.2));  // Too short counts as too long.
  EXPECT_NEAR(gate.MaxDistance_m(), 3 * std::sqrt(1.6), 1e-12);
}

// At 100 m, a turn by 60 degrees moves a point by 2 * 100 * sin(30 deg) = 100 m.
TEST(AdaptiveGate, TakesTurnsAtTheFarthestRange) {
  AdaptiveGate gate(90);
  gate.Add(Motion(0, 0), Motion(M_PI / 3, 0));
  EXPECT_NEAR(gate.MaxDistance_m(), 3 * std::sqrt((8100 + 1e4) / 2), 1e-9);
  gate.Add(Motion(0.5, 0), Motion(0.5 - M_PI, 0.25));  // The farthest: 200 m, and the translation.
  EXPECT_NEAR(gate.MaxDistance_m(), 3 * std::sqrt((8100 + 1e4 + 200.25 * 200.25) / 3), 1e-9);
}

// One scan that is 100 m off counts as 10 m, and leaves the gate at five times the first error.
TEST(AdaptiveGate, HasACeiling) {
  AdaptiveGate gate(2);
  gate.Add(Motion(0, 0), Motion(0, 100));
  EXPECT_EQ(gate.MaxDistance_m(), 10);
  for (int i = 0; i < 8; ++i) {
    gate.Add(Motion(0, 0), Motion(0, 0.2));
  }
  EXPECT_NEAR(gate.MaxDistance_m(), 3 * std::sqrt((4 + 100 + 8 * 0.04) / 10), 1e-12);
}

// The error is the motion from the predicted to the found pose: what they share does not count.
TEST(AdaptiveGate, ComparesPosesNotNumbers) {
  AdaptiveGate gate(1);
  const SE3d error = Motion(0.002, 0.3);
  gate.Add(Motion(2, 50), Motion(2, 50) * error);
  const double delta = 0.3 + 200 * std::sin(0.001);
  EXPECT_NEAR(gate.MaxDistance_m(), 3 * std::sqrt((1 + delta * delta) / 2), 1e-9);
}

TEST(AdaptiveGate, PassesOverGoodPredictions) {
  AdaptiveGate gate(2);
  for (int i = 0; i < 10; ++i) {
    gate.Add(Motion(0.1, 1), Motion(0.1, 1));           // A predicted pose that was kept.
    gate.Add(Motion(0.1, 1), Motion(0.1, 1 + 0.0999));  // Below 0.1 m.
    gate.Add(Motion(0, 1), Motion(0.00099, 1));         // 100 m * 0.00099.
  }
  EXPECT_DOUBLE_EQ(gate.MaxDistance_m(), 6);
  gate.Add(Motion(0, 1), Motion(0.0009, 1.02));  // 0.09 + 0.02 m.
  EXPECT_LT(gate.MaxDistance_m(), 6);
}

}  // namespace
}  // namespace icpscape
