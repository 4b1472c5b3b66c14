// SPDX-License-Identifier: BSD-3-Clause
// What holds in every mode.
#include "icpscape/odometry/odometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "icpscape/common/error.h"
#include "icpscape/residuals/registry.h"
#include "tests/odometry/drives.h"
#include "tests/support/message_of.h"
#include "tests/support/named.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using namespace testing_support;  // NOLINT: the helpers of these tests, all of them.
using testing::HasSubstr;

class EveryMode : public testing::TestWithParam<Named<OdometryMode>> {
 protected:
  static OdometryMode Mode() { return GetParam().value; }
};
INSTANTIATE_TEST_SUITE_P(
    Odometry, EveryMode,
    testing::Values(Named<OdometryMode>{"scan_to_scan", OdometryMode::kScanToScan},
                    Named<OdometryMode>{"scan_to_map", OdometryMode::kScanToMap},
                    Named<OdometryMode>{"two_stage", OdometryMode::kTwoStage}),
    testing::PrintToStringParamName());

TEST_P(EveryMode, FollowsTheTruth) {
  for (const Metrics& metrics : {kPlanes, kSymmetric, kLoam}) {
    const std::vector<FrameResult> results = RunAll(Options(Mode(), metrics), TownDrive().scans);
    const double limit_m = metrics == kLoam ? 0.08 : 0.05;  // Of 5.6 m.
    for (std::size_t i = 0; i < results.size(); ++i) {
      const SE3d& truth = TownDrive().T_world_lidar[i];
      EXPECT_LT(DistanceM(results[i].T_world_lidar, truth), limit_m) << metrics[0] << " " << i;
      EXPECT_LT(AngleDeg(results[i].T_world_lidar, truth), 0.25) << metrics[0] << " " << i;
      EXPECT_EQ(results[i].registered, i > 0);
      EXPECT_EQ(results[i].iterations > 0, i > 0);
      EXPECT_EQ(results[i].n > 100, i > 0);
      EXPECT_EQ(results[i].gate_m > 0, i > 0);
      EXPECT_GT(results[i].points, 3000U);
    }
    EXPECT_GT(TownDrive().T_world_lidar.back().t().norm(), 5);
  }
}

TEST_P(EveryMode, IsTheSameForAnyNumberOfThreads) {
  for (const Metrics& metrics : {kPlanes, kLoam}) {
    OdometryOptions options = Options(Mode(), metrics);
    options.threads = 1;
    const auto one = Bits(RunAll(options, FirstScans(4)));
    for (const int threads : {2, 4}) {
      options.threads = threads;
      EXPECT_EQ(Bits(RunAll(options, FirstScans(4))), one) << metrics[0];
    }
  }
}

// Stopped after any number of scans and resumed from the journal's text.
TEST_P(EveryMode, GoesOnAfterAReplayAsIfItHadNotStopped) {
  for (const Metrics& metrics : {kPlanes, kLoam}) {
    const std::vector<PointCloud> scans = FirstScans(metrics == kLoam ? 4 : 6);
    const OdometryOptions options = Options(Mode(), metrics);
    const auto whole = RunAll(options, scans);
    for (std::size_t stop = 1; stop < scans.size(); ++stop) {
      Odometry odometry(options);
      for (std::size_t i = 0; i < stop; ++i) {
        FrameRecord record;
        record.scan_sha256 = "0";
        record.result = whole[i];
        odometry.Replay(scans[i], ParseFrameRecord(FormatFrameRecord(record), "").result);
      }
      EXPECT_EQ(odometry.size(), static_cast<int>(stop));
      for (std::size_t i = stop; i < scans.size(); ++i) {
        EXPECT_EQ(Bits(odometry.Add(scans[i])), Bits(whole[i])) << metrics[0] << " " << stop;
      }
    }
  }
}

// A covered sensor sees next to nothing: the car goes on as before, and so does the odometry.
TEST_P(EveryMode, PredictsWhereAScanCannotBeRegistered) {
  PointCloud nothing;
  PointCloud far_away;
  for (const double y : {0.0, 1.0, 2.0}) {
    testing_support::AddPoint(Vec3(3000, y, 0), &far_away);
  }
  for (const PointCloud& bad : {nothing, far_away}) {
    std::vector<PointCloud> scans = TownDrive().scans;
    scans[4] = bad;
    const std::vector<FrameResult> results = RunAll(Options(Mode()), scans);
    EXPECT_FALSE(results[4].registered);
    EXPECT_EQ(results[4].points, bad.size());
    EXPECT_EQ(results[4].motion.Matrix(), results[3].motion.Matrix());
    EXPECT_EQ((results[3].T_world_lidar * results[3].motion).Normalized().Matrix(),
              results[4].T_world_lidar.Matrix());
    EXPECT_EQ(results[5].gate_m, results[4].gate_m);  // A kept predicted pose does not count.
    // The next scans are registered to what was there before.
    for (const std::size_t i : {5U, 6U, 7U}) {
      EXPECT_TRUE(results[i].registered) << i;
      EXPECT_LT(DistanceM(results[i].T_world_lidar, TownDrive().T_world_lidar[i]), 0.1) << i;
    }
  }
}

// Rings are needed, and points in no order have none: one such scan is an accident, a drive of them
// is not for these metrics.
TEST_P(EveryMode, PredictsWhereAScanHasNoRings) {
  std::vector<PointCloud> scans = FirstScans(6);
  scans[2] = testing_support::Room(3000, 1);
  const OdometryOptions options = Options(Mode(), kLoam);
  const std::vector<FrameResult> results = RunAll(options, scans);
  EXPECT_FALSE(results[2].registered);
  EXPECT_EQ(results[2].points, 0U);
  EXPECT_EQ(results[2].motion.Matrix(), results[1].motion.Matrix());
  EXPECT_TRUE(results[5].registered);
  EXPECT_LT(DistanceM(results[5].T_world_lidar, TownDrive().T_world_lidar[5]), 0.15);
  Odometry replayed(options);
  for (std::size_t i = 0; i < 4; ++i) {
    replayed.Replay(scans[i], results[i]);
  }
  EXPECT_EQ(Bits(replayed.Add(scans[4])), Bits(results[4]));
  Odometry odometry(options);
  EXPECT_THAT(MessageOf([&] { odometry.Add(scans[2]); }), HasSubstr("by their azimuth"));
}

TEST_P(EveryMode, PredictsWhereTheFiltersLeaveNothing) {
  OdometryOptions options = Options(Mode());
  options.filters.ego_blind_spot_m = 1000;
  for (const FrameResult& result : RunAll(options, FirstScans(3))) {
    EXPECT_FALSE(result.registered);
    EXPECT_EQ(result.T_world_lidar.Matrix(), SE3d().Matrix());
    EXPECT_EQ(result.n, 0);
  }
}

TEST_P(EveryMode, TakesFilters) {
  OdometryOptions options = Options(Mode());
  options.filters.ego_blind_spot_m = 5;
  const auto filtered = RunAll(options, TownDrive().scans);
  const auto whole = RunAll(Options(Mode()), TownDrive().scans);
  for (std::size_t i = 1; i < filtered.size(); ++i) {
    EXPECT_TRUE(filtered[i].registered) << i;
    EXPECT_LT(filtered[i].n, whole[i].n) << i;
    EXPECT_EQ(filtered[i].points, whole[i].points);  // Before the filters.
    EXPECT_LT(DistanceM(filtered[i].T_world_lidar, TownDrive().T_world_lidar[i]), 0.08) << i;
  }
}

TEST_P(EveryMode, TakesEveryMetricAndRejection) {
  const auto expect_motion = [](const OdometryOptions& options, const std::string& what) {
    const auto results = RunAll(options, FirstScans(4));
    for (std::size_t i = 1; i < results.size(); ++i) {
      EXPECT_TRUE(results[i].registered) << what << " " << i;
      EXPECT_GT(results[i].motion.t().x(), 0.01) << what << " " << i;  // Patches hold on.
      EXPECT_LT(DistanceM(results[i].motion, SE3d()), 1) << what << " " << i;
    }
  };
  OdometryOptions options;
  ForEachMetric([&](auto tag) {
    const std::string metric = decltype(tag)::Metric::kName;
    options = Options(Mode(), {metric});
    options.preparation.voxel_m = NeedsFeatures(metric) ? 0 : 0.25;
    options.minimizer.max_iterations = 5;
    expect_motion(options, metric);
  });
  options = Options(Mode(), {"point_to_point"});  // Normals that no metric needs.
  options.objective.matching.max_normal_angle_rad = 0.5;
  expect_motion(options, "normal angle");
  options = Options(Mode());
  options.objective.matching.reciprocal_epsilon_m = 0.1;
  expect_motion(options, "reciprocal");
  options.objective.matching.kept_fraction = 0.7;
  expect_motion(options, "trimmed");
  options = Options(Mode());
  options.objective.loss = MakeLoss("tolerant", 0.1);
  expect_motion(options, "tolerant");
  options = Options(Mode());
  options.adaptive_gate_m = 0;
  options.minimizer.reassociation = Reassociation::kEveryEvaluation;
  expect_motion(options, "every evaluation");
}

// After 20 km, where a float is rounded to 2 mm, a drive goes on as at home.
TEST_P(EveryMode, IsPreciseFarFromHome) {
  const OdometryOptions options = Options(Mode());
  const std::vector<PointCloud> scans = FirstScans(5);
  const auto home = RunAll(options, scans);
  Odometry odometry(options);
  FrameResult first = home[0];
  first.T_world_lidar = SE3d(Mat3::Identity(), Vec3(20000, -15000, 500));
  odometry.Replay(scans[0], first);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const SE3d T_world_lidar = odometry.Add(scans[i]).T_world_lidar;
    EXPECT_LT(DistanceM(first.T_world_lidar * home[i].T_world_lidar, T_world_lidar), 2e-3) << i;
  }
}

}  // namespace
}  // namespace icpscape
