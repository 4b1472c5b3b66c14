// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "icpscape/common/vehicle.h"

#include <cmath>
#include <random>

#include "icpscape/io/sequences.h"
#include "icpscape/landscape/path.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

constexpr double kLead = kSensorAheadOfRearAxle_m;

double Difference(const SE3d& a, const SE3d& b) { return (a.Inverse() * b).Log().norm(); }

SE3d Planar(double x, double y, double yaw) {
  Mat3 R = Mat3::Identity();
  R << std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0, 0, 1;
  return SE3d(R, Vec3(x, y, 0));
}

SE3d Random(std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vec6 xi;
  for (int k = 0; k < 6; ++k) {
    xi[k] = uniform(*random);
  }
  return SE3d::Exp(xi);
}

// A car on a circle: its rear axle's middle runs along an arc of the given length about a centre to
// the left (yaw > 0), written with the circle's radius; the sensor rides `kLead` in front of it.
SE3d CarOnCircle(double arc, double yaw) {
  const double radius = arc / yaw;
  const double axle_x = radius * std::sin(yaw), axle_y = radius * (1 - std::cos(yaw));
  return Planar(axle_x + kLead * std::cos(yaw) - kLead, axle_y + kLead * std::sin(yaw), yaw);
}

TEST(BicyclePath, FollowsTheCircleOfACar) {
  for (const double yaw : {0.7, -0.3, 0.02, -1e-7}) {
    const SE3d T_1 = CarOnCircle(2.5, yaw);
    const Path path(SE3d(), T_1, PathKind::kBicycle);
    for (const double u : {-1., -0.3, 0.25, 0.5, 1., 2.}) {
      EXPECT_LT(Difference(path.Pose(u), CarOnCircle(2.5 * u, yaw * u)), 1e-8) << yaw << " " << u;
    }
    // Such a motion has a constant twist, as the geodesic.
    const Path geodesic(SE3d(), T_1, PathKind::kGeodesic);
    EXPECT_LT(Difference(path.Pose(2), geodesic.Pose(2)), 1e-8);
  }
}

TEST(BicyclePath, DrivesStraightAheadAndBack) {
  for (const double length : {1.3, -0.8}) {
    const Path path(SE3d(), Planar(length, 0, 0), PathKind::kBicycle);
    EXPECT_LT(Difference(path.Pose(-1), Planar(-length, 0, 0)), 1e-14);
    EXPECT_LT(Difference(path.Pose(0.5), Planar(length / 2, 0, 0)), 1e-14);
    Vec6 forward = Vec6::Zero();
    forward[3] = length;
    EXPECT_LT((path.BodyTwist(0.3) - forward).norm(), 1e-14);
  }
}

TEST(BicyclePath, HeadsAlongTheArcOfItsRearAxle) {
  // The velocity of the axle's middle, l behind the sensor, has no sideways part at u = 0 but for
  // the remainder of a motion that no car can do, here none.
  const Path path(SE3d(), CarOnCircle(1.2, 0.4), PathKind::kBicycle);
  for (const double u : {-1., 0., 0.6, 2.}) {
    const Vec6 xi = path.BodyTwist(u);
    const Vec3 velocity = xi.tail<3>() + xi.head<3>().cross(Vec3(-kLead, 0, 0));
    EXPECT_NEAR(velocity.y(), 0, 1e-12);
    EXPECT_NEAR(velocity.x(), 1.2, 1e-12);
  }
}

TEST(BicyclePath, MeetsBothEndsOfAnyMotion) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 100; ++trial) {
    const SE3d T_0 = Random(&random), T_1 = T_0 * Random(&random);
    const Path path(T_0, T_1, PathKind::kBicycle);
    EXPECT_LT(Difference(path.Pose(0), T_0), 1e-13);
    EXPECT_LT(Difference(path.Pose(1), T_1), 1e-13);
  }
}

TEST(BicyclePath, HasTheExactBodyTwist) {
  std::mt19937 random(12);
  constexpr double kStep = 1e-5;
  for (int trial = 0; trial < 50; ++trial) {
    const SE3d T_0 = Random(&random), T_1 = T_0 * Random(&random);
    const Path path(T_0, T_1, PathKind::kBicycle);
    for (const double u : {-1., -0.4, 0., 0.5, 1., 2.}) {
      const Vec6 numeric =
          (path.Pose(u - kStep).Inverse() * path.Pose(u + kStep)).Log() / (2 * kStep);
      EXPECT_LT((path.BodyTwist(u) - numeric).norm(), 1e-7);
    }
  }
}

TEST(BicyclePath, MovesWithTheFrameOfTheTarget) {
  std::mt19937 random(13);
  const SE3d G = Random(&random), T_0 = Random(&random), T_1 = T_0 * Random(&random);
  const Path path(T_0, T_1, PathKind::kBicycle), moved(G * T_0, G * T_1, PathKind::kBicycle);
  for (const double u : {-1., 0.5, 2.}) {
    EXPECT_LT(Difference(G * path.Pose(u), moved.Pose(u)), 1e-12);
    EXPECT_LT((path.BodyTwist(u) - moved.BodyTwist(u)).norm(), 1e-12);
  }
}

TEST(BicyclePath, HasItsName) {
  EXPECT_EQ(FromName<PathKind>("bicycle"), PathKind::kBicycle);
  EXPECT_STREQ(NameOf(AllOf<PathKind>().back()), "bicycle");
}

TEST(BicyclePath, HasTheLeadOfKittisCar) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  // Over half a second the axle's chord lies along psi / 2, so the sensor's sideways motion across
  // it is 2 l sin(psi / 2): a regression over the whole drive gives l.
  const ScanSequence sequence = OpenKittiSequence(KittiRoot(), "07");
  const SE3d Tr = *sequence.T_camera_lidar;
  const std::vector<SE3d>& poses = sequence.T_world_camera;
  double sum_xy = 0, sum_xx = 0;
  for (std::size_t i = 0; i + 5 < poses.size(); i += 5) {
    const SE3d D = Tr.Inverse() * poses[i].Inverse() * poses[i + 5] * Tr;
    const double half = std::atan2(D.R()(1, 0), D.R()(0, 0)) / 2;
    const double sideways = -D.t().x() * std::sin(half) + D.t().y() * std::cos(half);
    sum_xy += 2 * std::sin(half) * sideways;
    sum_xx += 4 * std::sin(half) * std::sin(half);
  }
  EXPECT_NEAR(sum_xy / sum_xx, kLead, 0.02);
}

TEST(BicyclePath, BendsByTheSagittaOfARealTurn) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const SE3d T_1 = *OpenKittiSequence(KittiRoot(), "00").Motion(94, 95);
  const Path bicycle(SE3d(), T_1, PathKind::kBicycle), geodesic(SE3d(), T_1, PathKind::kGeodesic);
  const Path lerp(SE3d(), T_1, PathKind::kLerpSlerp);
  // 0.475 m and 1.24 degrees: the arc's sagitta s psi / 8 is 1.3 mm, and eight times that at u = 2.
  const auto apart = [&](const Path& other, double u) {
    return (bicycle.Pose(u).t() - other.Pose(u).t()).norm();
  };
  EXPECT_NEAR(apart(lerp, 0.5), 0.0013, 0.0002);
  EXPECT_NEAR(apart(lerp, 2), 0.0103, 0.0005);
  EXPECT_LT(apart(geodesic, 0.5), 1e-4);
  EXPECT_LT(apart(geodesic, 2), 1e-3);
}

}  // namespace
}  // namespace icpscape
