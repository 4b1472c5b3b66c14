// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/displacement.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace icpscape {
namespace {

// A quarter turn about z and a metre along y take (3, 0, 2) to (0, 4, 2).
TEST(Displacement, IsThatOfThePoint) {
  const SE3d T(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix(), Vec3(0, 1, 0));
  const Displacement moved = DisplacementAt({3, 0, 2}, T);
  EXPECT_NEAR(moved.m, 5, 1e-12);
  EXPECT_NEAR(moved.rad, M_PI / 2, 1e-12);
}

TEST(Displacement, OfTheSensorIsFromWhereItWas) {
  PointCloud source, target;
  source.sensor = {3, 0, 2};
  target.sensor = {0, 1, 2};
  const SE3d T(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix(), Vec3(0, 1, 0));
  EXPECT_NEAR(MotionOfSensor(source, target, T).m, 3, 1e-12);
  EXPECT_NEAR(MotionOfSensor(source, target, T).rad, M_PI / 2, 1e-12);
}

TEST(Displacement, OfTheSensorFarOutIsThatOfThePoseOfTheUser) {
  PointCloud source, target;
  source.sensor = {3, 0, 2};
  target.sensor = {0, 1, 2};
  source.origin = {458000, 5429000, 100};
  target.origin = {458010, 5429000, 90};
  const SE3d T(Eigen::AngleAxisd(0.1, Vec3::UnitZ()).toRotationMatrix(), Vec3(0, 1, 0));
  const Vec3 before = source.origin + source.sensor;
  const Vec3 after = target.origin + T * source.sensor;
  EXPECT_NEAR(MotionOfSensor(source, target, T).m, (after - before).norm(), 1e-9);
}

// The velocity of a point, by differences of where the motion takes it.
TEST(Displacement, VelocityAboutAPointIsThatOfThePoint) {
  const Vec3 c(30, -20, 4);
  const Vec6 xi = (Vec6() << 0.3, -0.1, 0.2, 1, 2, -3).finished();
  constexpr double kTime = 1e-6;
  const Vec3 velocity = (SE3d::Exp(kTime * xi) * c - SE3d::Exp(-kTime * xi) * c) / (2 * kTime);
  const Vec6 about = AboutPoint(c, 7) * xi;
  EXPECT_LT((about.tail<3>() - velocity).norm(), 1e-7);
  EXPECT_LT((about.head<3>() - 7 * xi.head<3>()).norm(), 1e-12);
}

TEST(Displacement, CentroidIsTheMean) {
  PointCloud cloud;
  EXPECT_EQ(CentroidOf(cloud), Vec3(0, 0, 0));
  testing_support::AddPoint({1, 2, 3}, &cloud);
  testing_support::AddPoint({4, -2, 5}, &cloud);
  testing_support::AddPoint({1, 3, 4}, &cloud);
  EXPECT_LT((CentroidOf(cloud) - Vec3(2, 1, 4)).norm(), 1e-12);
}

}  // namespace
}  // namespace icpscape
