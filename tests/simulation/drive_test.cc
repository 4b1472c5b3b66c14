// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "icpscape/neighbors/neighbor_search.h"
#include "icpscape/simulation/simulator.h"

namespace icpscape {
namespace {

// Once around a block of 120 m by 80 m, and on along its first side; half a metre a frame.
std::vector<SE3d> AroundTheBlock(double laps) {
  std::vector<SE3d> poses;
  constexpr double kLap = 400;
  for (double s = 0; s < laps * kLap; s += 0.5) {
    const double along = std::fmod(s, kLap);
    double x = along, y = 0, yaw = 0;
    if (along > 320) {
      x = 0, y = 400 - along, yaw = -M_PI / 2;
    } else if (along > 200) {
      x = 320 - along, y = 80, yaw = M_PI;
    } else if (along > 120) {
      x = 120, y = along - 120, yaw = M_PI / 2;
    }
    // Hills and tilt, which the projection removes.
    const SE3d tilt(Eigen::AngleAxisd(0.02 * std::sin(s), Vec3::UnitY()).toRotationMatrix(),
                    Vec3(0, 0, std::sin(s / 30)));
    poses.push_back(Placement(x, y, 0, yaw) * tilt);
  }
  return poses;
}

std::vector<Vec2> Route(const std::vector<SE3d>& poses) {
  std::vector<Vec2> route;
  for (const SE3d& T : poses) {
    route.push_back(T.t().head<2>());
  }
  return route;
}

TEST(Drive, IsProjectedToTheGround) {
  const std::vector<SE3d> poses = AroundTheBlock(1);
  const std::vector<SE3d> projected = ProjectToGround(poses);
  ASSERT_EQ(projected.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(projected[i].t().head<2>(), poses[i].t().head<2>());
    EXPECT_EQ(projected[i].t().z(), 1.73);
    EXPECT_NEAR((projected[i].R() * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 0, 1e-12);
    // Heading of the forward axis, seen from above.
    const Vec3 forward = poses[i].R() * Vec3::UnitX();
    const Vec3 level = projected[i].R() * Vec3::UnitX();
    EXPECT_NEAR(std::atan2(forward.y(), forward.x()), std::atan2(level.y(), level.x()), 1e-12);
  }
}

TEST(Drive, ASecondLapAddsNoStreet) {
  const std::vector<Street> once = StreetsAlong(Route(AroundTheBlock(1)));
  const std::vector<Street> twice = StreetsAlong(Route(AroundTheBlock(1.9)));
  EXPECT_EQ(once.size(), 4U);
  EXPECT_EQ(twice.size(), once.size());
}

TEST(Drive, TheRouteStaysOnTheCarriageway) {
  const std::vector<Vec2> route = Route(AroundTheBlock(1.5));
  const StreetNetwork network(StreetsAlong(route), 1);
  for (const Vec2& p : route) {
    EXPECT_LT(network.DistanceToKerb(p), -2) << p.transpose();
  }
}

TEST(Drive, ComingBackTheWorldIsTheSame) {
  const std::vector<SE3d> poses = AroundTheBlock(1.3);
  Drive drive = MakeDrive(poses, 2);
  LidarOptions perfect;
  perfect.range_noise_m = perfect.ring_bias_m = perfect.dropout = 0;
  const Simulator simulator(drive.world, perfect, 2);
  // Frame 100 stands 50 m along the first side, and so does frame 900, a lap later.
  const PointCloud first = simulator.Scan(drive.T_world_lidar[100], 10, 100, 2);
  const PointCloud again = simulator.Scan(drive.T_world_lidar[900], 90, 900, 2);
  const NeighborSearch search(first.View());
  std::vector<float> distances;
  for (std::size_t i = 0; i < again.size(); i += 10) {
    distances.push_back(search.Nearest(again.Point(i).cast<float>(), 1e6F).squared_distance);
  }
  std::nth_element(distances.begin(), distances.begin() + static_cast<long>(distances.size() / 2),
                   distances.end());
  EXPECT_LT(std::sqrt(distances[distances.size() / 2]), 0.03);
}

TEST(Drive, StandingStillHasAStreet) {
  const Drive drive = MakeDrive({SE3d(), SE3d()}, 1);
  EXPECT_GT(drive.world.standing.size(), 1000U);
}

TEST(StreetNetwork, MeasuresToTheKerb) {
  const StreetNetwork network({{{Vec2(-50, 0), Vec2(50, 0)}}, {{Vec2(0, -50), Vec2(0, 50)}}}, 1);
  EXPECT_NEAR(network.DistanceToKerb(Vec2(20, 0)), -4.75, 1e-12);
  EXPECT_NEAR(network.DistanceToKerb(Vec2(20, 6)), 1.25, 1e-12);
  EXPECT_NEAR(network.DistanceToKerb(Vec2(20, 0), 0), 15.25, 1e-12);
  // 2.5 % of crown over 4.75 m, and 6 mm of unevenness.
  EXPECT_NEAR(network.RoadHeight(Vec2(20, 0)), 0.119, 0.0061);
  EXPECT_NEAR(network.RoadHeight(Vec2(20, 4.75)), 0, 0.0061);
}

}  // namespace
}  // namespace icpscape
