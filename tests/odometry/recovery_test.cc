// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/recovery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "icpscape/objective/loss.h"
#include "icpscape/odometry/odometry.h"
#include "icpscape/simulation/drive.h"
#include "icpscape/simulation/simulator.h"

namespace icpscape {
namespace {

constexpr int kScans = 16;
constexpr int kFirstTurn = 8;

struct Walk {
  std::vector<PointCloud> scans;
  std::vector<SE3d> T_first_lidar;
};

// A person who walks through a town with a lidar in the hand, and turns from scan to scan, three
// times.
const Walk& HandHeldTurn(double turn_deg = 50) {
  static std::map<double, Walk> walks;
  const auto walk = [&] {
    std::vector<SE3d> route(1);
    for (int i = 1; i < 60; ++i) {
      route.push_back(route.back() *
                      SE3d::Exp((Vec6() << 0, 0, 0.3 * M_PI / 180, 0.8, 0, 0).finished()));
    }
    Drive drive = MakeDrive(route, 3);
    SE3d T = drive.T_world_lidar[30];
    LidarOptions lidar;
    lidar.azimuth_step_deg = 0.72;
    const Simulator simulator(std::move(drive.world), lidar, 1);
    const SE3d first = T;
    Walk result;
    for (int i = 0; i < kScans; ++i) {
      result.scans.push_back(simulator.Scan(LidarMotion(T), 0, i, 2));
      result.T_first_lidar.push_back(first.Inverse() * T);
      const bool turns = i >= kFirstTurn && i < kFirstTurn + 3;
      const double yaw = (turns ? turn_deg : 0.5 * std::sin(i)) * M_PI / 180;
      T = T * SE3d::Exp((Vec6() << 0, 0, yaw, 0.15, 0, 0).finished());
    }
    return result;
  };
  if (walks.count(turn_deg) == 0) {
    walks[turn_deg] = walk();
  }
  return walks[turn_deg];
}

OdometryOptions Options(OdometryMode mode) {
  OdometryOptions options;
  options.mode = mode;
  options.preparation.voxel_m = 0.25;
  options.objective.loss = MakeLoss("huber", 0.1);
  options.adaptive_gate_m = 2;
  options.threads = 2;
  return options;
}

void ExpectTruth(OdometryMode mode, const Walk& walk) {
  Odometry odometry(Options(mode));
  int recovered = 0;
  for (int i = 0; i < kScans; ++i) {
    const FrameResult result = odometry.Add(walk.scans[static_cast<std::size_t>(i)]);
    recovered += result.recovered ? 1 : 0;
    const SE3d off =
        walk.T_first_lidar[static_cast<std::size_t>(i)].Inverse() * result.T_world_lidar;
    EXPECT_LT(off.t().norm(), 0.05) << i;
    EXPECT_LT(off.LogRotation().norm(), 0.5 * M_PI / 180) << i;
    if (i < kFirstTurn) {
      EXPECT_FALSE(result.recovered) << i;
    }
  }
  EXPECT_GE(recovered, 1);
}

class Recovery : public testing::TestWithParam<OdometryMode> {};

// After the turn by 70 degrees a scan converges to a wrong pose; after that by 50 one ends at the
// limit.
TEST_P(Recovery, FindsALostSensorAgain) {
  for (const double turn_deg : {50.0, 70.0}) {
    ExpectTruth(GetParam(), HandHeldTurn(turn_deg));
  }
}

// The state after a replayed scan is the one after Add.
TEST_P(Recovery, GoesOnFromReplayedScans) {
  Odometry added(Options(GetParam())), replayed(Options(GetParam()));
  for (int i = 0; i <= kFirstTurn + 1; ++i) {
    const PointCloud& scan = HandHeldTurn().scans[static_cast<std::size_t>(i)];
    const FrameResult result = added.Add(scan);
    if (i < kFirstTurn) {
      replayed.Replay(scan, result);
      continue;
    }
    const FrameResult again = replayed.Add(scan);
    EXPECT_EQ(again.T_world_lidar.Matrix(), result.T_world_lidar.Matrix()) << i;
    EXPECT_EQ(again.recovered, result.recovered) << i;
  }
}

TEST(RecoveryOfEveryEvaluation, GoesOnWhereAScanIsLost) {
  OdometryOptions options = Options(OdometryMode::kScanToMap);
  options.adaptive_gate_m = 0;
  options.minimizer.reassociation = Reassociation::kEveryEvaluation;
  options.minimizer.max_iterations = 8;
  Odometry odometry(options);
  for (int i = kFirstTurn - 3; i < kFirstTurn + 4; ++i) {
    EXPECT_NO_THROW(odometry.Add(HandHeldTurn().scans[static_cast<std::size_t>(i)])) << i;
  }
  EXPECT_EQ(odometry.size(), 7);
}

INSTANTIATE_TEST_SUITE_P(Modes, Recovery,
                         testing::Values(OdometryMode::kScanToScan, OdometryMode::kScanToMap),
                         [](const auto& mode) { return NameOf(mode.param); });

TEST(FindStart, SeesThroughATurnAndAGateThatHidesTheWay) {
  const auto prepared = [](int i) {
    return Prepare(HandHeldTurn().scans[static_cast<std::size_t>(i)], kTargetNormal, {}, 2);
  };
  const PreparedScan source = prepared(kFirstTurn + 1), target = prepared(kFirstTurn);
  ObjectiveSetOptions gated;
  gated.matching.max_distance_m = 0.01;
  const std::optional<SE3d> start = FindStart(*source.clouds().points, *target.clouds().points,
                                              {"point_to_plane"}, {}, gated, {}, SE3d(), SE3d());
  ASSERT_TRUE(start.has_value());
  const SE3d truth = HandHeldTurn().T_first_lidar[kFirstTurn].Inverse() *
                     HandHeldTurn().T_first_lidar[kFirstTurn + 1];
  EXPECT_GT(truth.LogRotation().norm(), 45 * M_PI / 180);
  EXPECT_LT((truth.Inverse() * *start).t().norm(), 0.1);
  EXPECT_LT((truth.Inverse() * *start).LogRotation().norm(), 1 * M_PI / 180);
}

}  // namespace
}  // namespace icpscape
