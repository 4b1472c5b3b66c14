// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/constant_velocity.h"

#include <gtest/gtest.h>

#include <limits>

namespace icpscape {
namespace {

const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.02, 0.3, 1.5, 0.2, -0.1).finished());

TEST(MotionDuring, GoesOnAtTheSameVelocity) {
  const SE3d twice = MotionDuring(0.2, kMotion, 0.1);
  EXPECT_LT((twice.Matrix() - (kMotion * kMotion).Matrix()).norm(), 1e-12);
  const SE3d half = MotionDuring(0.05, kMotion, 0.1);
  EXPECT_LT(((half * half).Matrix() - kMotion.Matrix()).norm(), 1e-12);
  // Backwards in time, both of them.
  EXPECT_LT((MotionDuring(-0.2, kMotion, -0.1).Matrix() - twice.Matrix()).norm(), 1e-12);
  // On a circle of 2 m, by hand: 90 degrees after three times 30.
  const SE3d arc = SE3d::Exp((Vec6() << 0, 0, M_PI / 6, 2 * M_PI / 6, 0, 0).finished());
  EXPECT_LT((MotionDuring(0.3, arc, 0.1).t() - Vec3(2, 2, 0)).norm(), 1e-12);
}

TEST(MotionDuring, TakesJitterForNothing) {
  EXPECT_EQ(MotionDuring(0.1037, kMotion, 0.1).Matrix(), kMotion.Matrix());
  EXPECT_EQ(MotionDuring(0.0963, kMotion, 0.1).Matrix(), kMotion.Matrix());
  EXPECT_NE(MotionDuring(0.112, kMotion, 0.1).Matrix(), kMotion.Matrix());
  EXPECT_NE(MotionDuring(0.088, kMotion, 0.1).Matrix(), kMotion.Matrix());
}

TEST(MotionDuring, IsTheMotionWhereTimesAreNotKnown) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [span, motion_span] :
       {std::pair{nan, 0.1}, {0.5, nan}, {0.5, 0.0}, {0.0, 0.5}, {-0.5, 0.1}}) {
    EXPECT_EQ(MotionDuring(span, kMotion, motion_span).Matrix(), kMotion.Matrix()) << span;
  }
}

}  // namespace
}  // namespace icpscape
