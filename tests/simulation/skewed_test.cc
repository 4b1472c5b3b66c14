// SPDX-License-Identifier: BSD-3-Clause
// Scans of a lidar that moves while it turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "icpscape/simulation/lidar.h"
#include "icpscape/simulation/simulated_sequence.h"
#include "icpscape/simulation/simulator.h"

namespace icpscape {
namespace {

LidarOptions Skewed(bool skewed = true) {
  LidarOptions options;
  options.range_noise_m = options.ring_bias_m = options.dropout = 0;
  options.azimuth_step_deg = 1;
  options.skewed = skewed;
  return options;
}

// A wall of 200 m across the x axis.
Mesh WallAt(double x) {
  Mesh mesh;
  mesh.AddQuad(Vec3(x, -100, -100), Vec3(x, 100, -100), Vec3(x, 100, 100), Vec3(x, -100, 100),
               {Label::kBuilding, Material::kPlaster, 7});
  return mesh;
}

TEST(LidarMotion, TurnsFromBackwardToBackward) {
  EXPECT_EQ(LidarMotion::TimeOf(0), 0);
  EXPECT_DOUBLE_EQ(LidarMotion::TimeOf(M_PI / 2), 0.025);
  EXPECT_DOUBLE_EQ(LidarMotion::TimeOf(3 * M_PI / 2), -0.025);
  EXPECT_NEAR(LidarMotion::TimeOf(M_PI - 1e-9), 0.05, 1e-9);
  EXPECT_NEAR(LidarMotion::TimeOf(M_PI + 1e-9), -0.05, 1e-9);
}

TEST(LidarMotion, GoesThroughThePoses) {
  const SE3d first = SE3d::Exp((Vec6() << 0, 0, 0.1, 1, 0.2, 0).finished());
  const SE3d second = SE3d::Exp((Vec6() << 0.1, 0, -0.2, 2, 0, 0.3).finished());
  const std::vector<SE3d> poses = {SE3d(), first, first * second};
  const std::vector<LidarMotion> motions = MotionsThrough(poses);
  ASSERT_EQ(motions.size(), 3U);
  const auto expect_at = [&](std::size_t i, double time_s, const SE3d& T) {
    EXPECT_LT((motions[i].At(time_s).Matrix() - T.Matrix()).norm(), 1e-12) << i << " " << time_s;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    expect_at(i, 0, poses[i]);
  }
  expect_at(0, 0.1, poses[1]);
  expect_at(1, -0.1, poses[0]);
  expect_at(1, 0.1, poses[2]);
  expect_at(2, -0.1, poses[1]);
  expect_at(2, 0.1, poses[2] * second);  // It goes on ...
  expect_at(0, -0.1, first.Inverse());   // ... at both ends.
  EXPECT_LT((motions[1].At(0.05).Matrix() - motions[2].At(-0.05).Matrix()).norm(), 1e-12);
  EXPECT_EQ(MotionsThrough({first})[0].At(0.05).Matrix(), first.Matrix());
}

TEST(SkewedScan, SeesEachPointFromThePoseOfItsTime) {
  const SE3d T_world_lidar = SE3d::Exp((Vec6() << 0, 0.02, 0.3, 1, 2, 0).finished());
  LidarMotion motion(T_world_lidar);
  motion.before = (Vec6() << 0, 0, 0.5, 10, 0, 0).finished();
  motion.after = (Vec6() << 0, 0, -0.8, 20, 1, 0).finished();
  const RayCaster wall(WallAt(20));
  const PointCloud cloud = ScanWorld(wall, nullptr, motion, Skewed(), 5, 1, 2);
  ASSERT_GT(cloud.size(), 1000U);
  ASSERT_EQ(cloud.time_s.size(), cloud.size());
  double skew = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(cloud.time_s[i], std::atan2(cloud.y[i], cloud.x[i]) / (2 * M_PI) * 0.1, 1e-6);
    ASSERT_NEAR((motion.At(cloud.time_s[i]) * cloud.Point(i)).x(), 20, 1e-4);
    skew = std::max(skew, std::abs((T_world_lidar * cloud.Point(i)).x() - 20));
  }
  EXPECT_GT(skew, 0.3);
  // A snapshot does not care for the motion.
  const PointCloud moved = ScanWorld(wall, nullptr, motion, Skewed(false), 5, 1, 2);
  EXPECT_TRUE(moved.time_s.empty());
  EXPECT_EQ(moved.x, ScanWorld(wall, nullptr, T_world_lidar, Skewed(false), 5, 1, 2).x);
}

// The wall comes at 15 m/s, and is 20 m away at 3 s.
TEST(SkewedScan, SeesWhatMovesWhereItIsThen) {
  World world;
  world.moving.push_back({WallAt(65), SE3d(), Vec3(-15, 0, 0)});
  const PointCloud cloud = Simulator(world, Skewed(), 1).Scan(SE3d(), 3, 0, 2);
  ASSERT_GT(cloud.size(), 1000U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_NEAR(cloud.x[i], 20 - 15 * cloud.time_s[i], 2e-4);
  }
  const auto [least, most] = std::minmax_element(cloud.x.begin(), cloud.x.end());
  EXPECT_GT(*most - *least, 0.5);
}

TEST(SkewedScan, IsOneOfASequence) {
  LidarOptions options = Skewed();
  options.azimuth_step_deg = 2;
  DroppedPoints dropped;
  const PointCloud skewed = SimulatedSequence("right_turn", 1, options, 2).scans[1].read(&dropped);
  options.skewed = false;
  const PointCloud snapshot =
      SimulatedSequence("right_turn", 1, options, 2).scans[1].read(&dropped);
  EXPECT_EQ(skewed.time_s.size(), skewed.size());
  EXPECT_TRUE(snapshot.time_s.empty());
  EXPECT_NE(skewed.x, snapshot.x);
}

}  // namespace
}  // namespace icpscape
