// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/landscape/path.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "icpscape/common/error.h"
#include "icpscape/testing/residual_sampler.h"

namespace icpscape {
namespace {

const PathKind kKinds[] = {PathKind::kLerpSlerp, PathKind::kGeodesic};

TEST(Path, PassesThroughItsEnds) {
  ResidualSampler sampler(1);
  for (const PathKind kind : kKinds) {
    for (int i = 0; i < 100; ++i) {
      const SE3d T_0 = sampler.Pose(3, 1), T_1 = sampler.Pose(3, 1.5);
      const Path path(T_0, T_1, kind);
      EXPECT_LE((path.Pose(0).Matrix() - T_0.Matrix()).norm(), 1e-13);
      EXPECT_LE((path.Pose(1).Matrix() - T_1.Matrix()).norm(), 1e-13);
    }
  }
}

// The slerp of Eigen agrees inside [0, 1]; outside ours goes on at the same speed.
TEST(Path, LerpSlerpIsTheFormula) {
  ResidualSampler sampler(2);
  const SE3d T_0 = sampler.Pose(3, 1), T_1 = sampler.Pose(3, 1.5);
  const Path path(T_0, T_1, PathKind::kLerpSlerp);
  const Eigen::Quaterniond q_0(T_0.R()), q_1(T_1.R());
  for (const double u : {0.1, 0.3, 0.9}) {
    EXPECT_LE((path.Pose(u).R() - q_0.slerp(u, q_1).toRotationMatrix()).norm(), 1e-13);
    EXPECT_LE((path.Pose(u).t() - ((1 - u) * T_0.t() + u * T_1.t())).norm(), 1e-14);
  }
  const Mat3 step = T_0.R().transpose() * T_1.R();
  EXPECT_LE((path.Pose(2).R() - T_0.R() * step * step).norm(), 1e-13);
  EXPECT_LE((path.Pose(-1).R() - T_0.R() * step.transpose()).norm(), 1e-13);
}

TEST(Path, GeodesicRepeatsTheMotion) {
  ResidualSampler sampler(3);
  const SE3d T = sampler.Pose(3, 1);
  const Path path(SE3d(), T, PathKind::kGeodesic);
  EXPECT_LE((path.Pose(2).Matrix() - (T * T).Matrix()).norm(), 1e-13);
  EXPECT_LE((path.Pose(-1).Matrix() - T.Inverse().Matrix()).norm(), 1e-13);
}

// By hand: 1 m forwards along a chord with 5 degrees of yaw. The two paths part by chord times yaw
// outside: 8.7 cm at u = -1 and 2.
TEST(Path, TheTwoPathsPartByChordTimesYaw) {
  const double yaw = 5 * M_PI / 180;
  const SE3d T_1(Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), Vec3(1, 0, 0));
  const Path chord(SE3d(), T_1, PathKind::kLerpSlerp);
  const Path arc(SE3d(), T_1, PathKind::kGeodesic);
  EXPECT_NEAR((chord.Pose(2).t() - arc.Pose(2).t()).norm(), 0.087, 5e-4);
  EXPECT_NEAR((chord.Pose(-1).t() - arc.Pose(-1).t()).norm(), 0.087, 5e-4);
  EXPECT_NEAR((chord.Pose(0.5).t() - arc.Pose(0.5).t()).norm(), 0.011, 5e-4);
}

TEST(Path, BodyTwistIsTheDerivative) {
  ResidualSampler sampler(4);
  constexpr double h = 1e-5;
  for (const PathKind kind : kKinds) {
    for (int i = 0; i < 100; ++i) {
      const Path path(sampler.Pose(3, 1), sampler.Pose(3, 1), kind, Vec3(5, -4, 3));
      const double u = sampler.Uniform(-1, 2);
      const Vec6 numeric = (path.Pose(u - h).Inverse() * path.Pose(u + h)).Log() / (2 * h);
      EXPECT_LE((path.BodyTwist(u) - numeric).norm(), 1e-8);
    }
  }
}

// The same motion of the same sensor, with the origins of both frames put elsewhere: every kind of
// path takes a point of the world through the same places. Without the sensor's place, two do not.
TEST(Path, OfASensorDoesNotHangOnTheOrigins) {
  ResidualSampler sampler(5);
  const SE3d T_0 = sampler.Pose(3, 0.5), T_1 = sampler.Pose(3, 0.8);
  const Vec3 sensor(0.4, -0.2, 1.7);
  const SE3d source(Mat3::Identity(), Vec3(300, -150, 40));
  const SE3d target(Mat3::Identity(), Vec3(-90, 220, 60));
  const SE3d T_0_far = target * T_0 * source.Inverse(), T_1_far = target * T_1 * source.Inverse();
  const Vec3 sensor_far = source * sensor, point(10, 20, -1);
  for (const PathKind kind : AllOf<PathKind>()) {
    const Path here(T_0, T_1, kind, sensor), far(T_0_far, T_1_far, kind, sensor_far);
    const Path without(T_0_far, T_1_far, kind);
    double apart = 0;
    for (const double u : {-1.0, 0.0, 0.3, 1.0, 2.0}) {
      const Vec3 place = target * (here.Pose(u) * point);
      EXPECT_LT((far.Pose(u) * (source * point) - place).norm(), 1e-10) << NameOf(kind) << u;
      apart = std::max(apart, (without.Pose(u) * (source * point) - place).norm());
      // The twist of the far frame, seen from here.
      EXPECT_LT((source.Inverse().Adjoint() * far.BodyTwist(u) - here.BodyTwist(u)).norm(), 1e-9);
    }
    EXPECT_EQ(apart > 0.1, kind != PathKind::kGeodesic) << NameOf(kind);
  }
  // By its definition: the place of the sensor goes straight.
  const Path path(T_0, T_1, PathKind::kLerpSlerp, sensor);
  EXPECT_LT((path.Pose(0.3) * sensor - (0.7 * (T_0 * sensor) + 0.3 * (T_1 * sensor))).norm(),
            1e-13);
  EXPECT_LT((path.PlaceOfSensor(T_1) - T_1 * sensor).norm(), 1e-13);
}

TEST(Path, TinyAndNoRotation) {
  for (const double angle : {0.0, 1e-15, 1e-9}) {
    const SE3d T_1(Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(), Vec3(1, 2, 3));
    for (const PathKind kind : kKinds) {
      const SE3d half = Path(SE3d(), T_1, kind).Pose(0.5);
      EXPECT_TRUE(half.Matrix().allFinite());
      EXPECT_LE((half.t() - Vec3(0.5, 1, 1.5)).norm(), 1e-8);
    }
  }
}

TEST(Path, RefusesToHaveNoLength) {
  const SE3d T = SE3d::Exp((Vec6() << 0.1, 0.2, 0.3, 4, 5, 6).finished());
  for (const PathKind kind : AllOf<PathKind>()) {
    EXPECT_THROW(Path(T, T, kind), ComputationError);
    Vec6 xi = Vec6::Zero();
    xi[2] = 1e-6;  // A turn on the spot, or a thousandth of a millimetre, is a path.
    EXPECT_NO_THROW(Path(T, T * SE3d::Exp(xi), kind));
    EXPECT_NO_THROW(Path(SE3d(), SE3d(Mat3::Identity(), Vec3(0, 1e-6, 0)), kind));
  }
}

TEST(Path, NamesGoRound) {
  EXPECT_EQ(FromName<PathKind>("geodesic"), PathKind::kGeodesic);
  EXPECT_EQ(FromName<PathKind>("lerp_slerp"), PathKind::kLerpSlerp);
  EXPECT_THROW(FromName<PathKind>("spline"), UsageError);
}

}  // namespace
}  // namespace icpscape
