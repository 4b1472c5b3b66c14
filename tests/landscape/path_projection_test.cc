// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/landscape/path_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/named.h"

namespace icpscape {
namespace {

using testing_support::Named;

constexpr double kLength_m = 10;

SE3d Pose(double roll, double pitch, double yaw, double x, double y, double z) {
  return SE3d::Exp((Vec6() << roll, pitch, yaw, x, y, z).finished());
}
SE3d Shift(double x, double y, double z) { return SE3d(Mat3::Identity(), Vec3(x, y, z)); }

class Projections : public testing::TestWithParam<Named<PathKind>> {
 protected:
  // A right turn, as a car drives it.
  const Path path_{SE3d(), Pose(0.002, -0.003, -0.05, 0.9, -0.03, 0.01), GetParam().value};
};

TEST_P(Projections, OfPosesOnThePathAreExact) {
  for (const double u : {-1.0, -0.37, 0.0, 0.123456789, 1.0, 1.7, 2.0}) {
    const PathProjection p = ProjectOntoPath(path_, path_.Pose(u), -1, 2, kLength_m);
    EXPECT_NEAR(p.u, u, 1e-13);
    EXPECT_LE(p.off_path_m, 1e-13);
    EXPECT_LE(p.off_path_rad, 1e-13);
  }
}

TEST_P(Projections, BeyondTheEndsAreTheEnds) {
  for (const auto& [u, end] : {std::pair(2.5, 2.0), std::pair(-1.5, -1.0)}) {
    const PathProjection p = ProjectOntoPath(path_, path_.Pose(u), -1, 2, kLength_m);
    EXPECT_EQ(p.u, end);
    const SE3d off = path_.Pose(end).Inverse() * path_.Pose(u);
    EXPECT_NEAR(p.off_path_m, off.t().norm(), 1e-12);
    EXPECT_NEAR(p.off_path_rad, off.LogRotation().norm(), 1e-12);
  }
}

// The second method: every u of a fine grid.
TEST_P(Projections, AgreeWithBruteForce) {
  std::mt19937 engine(1);
  const auto noise = [&] { return static_cast<double>(engine()) / 2147483648.0 - 1; };
  for (int trial = 0; trial < 20; ++trial) {
    const SE3d T =
        path_.Pose(0.5 + 2 * noise()) * Pose(0.02 * noise(), 0.02 * noise(), 0.02 * noise(),
                                             0.2 * noise(), 0.2 * noise(), 0.2 * noise());
    const auto distance = [&](double u) {
      const SE3d T_u = path_.Pose(u);
      return std::hypot((T.t() - T_u.t()).norm(),
                        kLength_m * Eigen::AngleAxisd(T_u.R().transpose() * T.R()).angle());
    };
    double best = -1;
    for (int i = 0; i <= 30000; ++i) {
      const double u = -1 + i * 1e-4;
      best = distance(u) < distance(best) ? u : best;
    }
    const PathProjection p = ProjectOntoPath(path_, T, -1, 2, kLength_m);
    EXPECT_NEAR(p.u, best, 1e-4);
    EXPECT_LE(distance(p.u), distance(best));
    EXPECT_NEAR(std::hypot(p.off_path_m, kLength_m * p.off_path_rad), distance(p.u), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(PathKinds, Projections,
                         testing::Values(Named<PathKind>{"lerp_slerp", PathKind::kLerpSlerp},
                                         Named<PathKind>{"geodesic", PathKind::kGeodesic},
                                         Named<PathKind>{"bicycle", PathKind::kBicycle}),
                         testing::PrintToStringParamName());

// 2 m straight ahead. To the side is off the path, ahead is along it.
TEST(Projection, OfDisplacedPosesByHand) {
  const Path path(SE3d(), Shift(2, 0, 0), PathKind::kLerpSlerp);
  const PathProjection aside = ProjectOntoPath(path, Shift(1.5, 0.3, -0.4), -1, 2, kLength_m);
  EXPECT_NEAR(aside.u, 0.75, 1e-7);
  EXPECT_NEAR(aside.off_path_m, 0.5, 1e-12);
  EXPECT_EQ(aside.off_path_rad, 0);
  const PathProjection turned =
      ProjectOntoPath(path, SE3d(Pose(0, 0, 0.02, 0, 0, 0).R(), Vec3(1.5, 0, 0)), -1, 2, kLength_m);
  EXPECT_NEAR(turned.u, 0.75, 1e-7);
  EXPECT_NEAR(turned.off_path_rad, 0.02, 1e-12);
}

// 1 m ahead while turning by 0.1 rad: at L = 10 m both count the same. A pose that went all the way
// but did not turn has d^2 = (1 - u)^2 + u^2, which is least half way.
TEST(Projection, WeighsRotationsByTheLength) {
  const Path path(SE3d(), SE3d(Pose(0, 0, 0.1, 0, 0, 0).R(), Vec3(1, 0, 0)), PathKind::kLerpSlerp);
  const SE3d T = Shift(1, 0, 0);
  EXPECT_NEAR(ProjectOntoPath(path, T, -1, 2, 10).u, 0.5, 1e-7);
  EXPECT_NEAR(ProjectOntoPath(path, T, -1, 2, 0).u, 1, 1e-7);
  EXPECT_NEAR(ProjectOntoPath(path, T, -1, 2, 20).u, 0.2, 1e-7);  // (1 - u)^2 + 4 u^2.
}

// A turn on the spot, of which only the place counts: every pose of the path is as near.
TEST(Projection, TakesTheSmallestUAmongEquals) {
  const Path path(SE3d(), Pose(0, 0, 0.1, 0, 0, 0), PathKind::kLerpSlerp);
  const PathProjection p = ProjectOntoPath(path, Shift(0, 2, 0), -1, 2, 0);
  EXPECT_EQ(p.u, -1);
  EXPECT_EQ(p.off_path_m, 2);
}

}  // namespace
}  // namespace icpscape
