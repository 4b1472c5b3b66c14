// SPDX-License-Identifier: BSD-3-Clause
#include "src/odometry/odometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "residuals/registry.h"
#include "src/common/error.h"
#include "src/objective/loss.h"
#include "src/odometry/frame_record.h"
#include "tests/support/drives.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::MessageOf;
using testing_support::TownDrive;
using Metrics = std::vector<std::string>;

constexpr OdometryMode kModes[] = {OdometryMode::kScanToScan, OdometryMode::kScanToMap,
                                   OdometryMode::kTwoStage};
const char* const kNames[] = {"scan_to_scan", "scan_to_map", "two_stage"};
const Metrics kPlanes = {"point_to_plane"};
const Metrics kSymmetric = {"symmetric"};
const Metrics kLoam = {"edge_to_line", "planar_to_plane"};

OdometryOptions Options(OdometryMode mode, const Metrics& metrics = kPlanes) {
  OdometryOptions options;
  options.mode = mode;
  options.metrics = metrics;
  options.preprocessing.voxel_m = metrics == kLoam ? 0 : 0.25;
  options.objective.loss = MakeLoss("huber", 0.1);
  options.adaptive_gate_m = 2;
  options.map_every = 2;
  options.threads = 2;
  return options;
}

std::vector<PointCloud> FirstScans(std::size_t count) {
  const std::vector<PointCloud>& scans = TownDrive().scans;
  return {scans.begin(), scans.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::vector<FrameResult> Drive(const OdometryOptions& options,
                               const std::vector<PointCloud>& scans) {
  Odometry odometry(options);
  std::vector<FrameResult> results;
  for (const PointCloud& scan : scans) {
    results.push_back(odometry.Add(scan));
  }
  return results;
}

double DistanceM(const SE3d& a, const SE3d& b) { return (a.Inverse() * b).t().norm(); }
double AngleDeg(const SE3d& a, const SE3d& b) {
  return (a.Inverse() * b).LogRotation().norm() * 180 / M_PI;
}

// All that there is in a result, bit for bit: FrameRecord's text is exact.
std::string Bits(const FrameResult& result) {
  FrameRecord record;
  record.result = result;
  return FormatFrameRecord(record);
}
std::vector<std::string> Bits(const std::vector<FrameResult>& results) {
  std::vector<std::string> bits;
  for (const FrameResult& result : results) {
    bits.push_back(Bits(result));
  }
  return bits;
}

class EveryMode : public testing::TestWithParam<OdometryMode> {};
INSTANTIATE_TEST_SUITE_P(Odometry, EveryMode, testing::ValuesIn(kModes),
                         [](const auto& mode) { return kNames[static_cast<int>(mode.param)]; });

TEST_P(EveryMode, FollowsTheTruth) {
  for (const Metrics& metrics : {kPlanes, kSymmetric, kLoam}) {
    const std::vector<FrameResult> results = Drive(Options(GetParam(), metrics), TownDrive().scans);
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
    OdometryOptions options = Options(GetParam(), metrics);
    options.threads = 1;
    const auto one = Bits(Drive(options, FirstScans(4)));
    for (const int threads : {2, 4}) {
      options.threads = threads;
      EXPECT_EQ(Bits(Drive(options, FirstScans(4))), one) << metrics[0];
    }
  }
}

// Stopped after any number of scans and resumed from the journal's text.
TEST_P(EveryMode, GoesOnAfterAReplayAsIfItHadNotStopped) {
  for (const Metrics& metrics : {kPlanes, kLoam}) {
    const std::vector<PointCloud> scans = FirstScans(metrics == kLoam ? 4 : 6);
    const OdometryOptions options = Options(GetParam(), metrics);
    const auto whole = Drive(options, scans);
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
    const std::vector<FrameResult> results = Drive(Options(GetParam()), scans);
    EXPECT_FALSE(results[4].registered);
    EXPECT_EQ(results[4].points, bad.size());
    EXPECT_EQ(results[4].motion.Matrix(), results[3].motion.Matrix());
    EXPECT_EQ((results[3].T_world_lidar * results[3].motion).Normalized().Matrix(),
              results[4].T_world_lidar.Matrix());
    EXPECT_EQ(results[5].gate_m, results[4].gate_m);  // A prediction is no evidence for itself.
    // Nothing can be registered to nothing either, but to the map it can.
    EXPECT_EQ(results[5].registered, GetParam() == OdometryMode::kScanToMap);
    for (const std::size_t i : {6U, 7U}) {
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
  const OdometryOptions options = Options(GetParam(), kLoam);
  const std::vector<FrameResult> results = Drive(options, scans);
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
  OdometryOptions options = Options(GetParam());
  options.filters.ego_blind_spot_m = 1000;
  for (const FrameResult& result : Drive(options, FirstScans(3))) {
    EXPECT_FALSE(result.registered);
    EXPECT_EQ(result.T_world_lidar.Matrix(), SE3d().Matrix());
    EXPECT_EQ(result.n, 0);
  }
}

TEST_P(EveryMode, TakesFilters) {
  OdometryOptions options = Options(GetParam());
  options.filters.ego_blind_spot_m = 5;
  const auto filtered = Drive(options, TownDrive().scans);
  const auto whole = Drive(Options(GetParam()), TownDrive().scans);
  for (std::size_t i = 1; i < filtered.size(); ++i) {
    EXPECT_TRUE(filtered[i].registered) << i;
    EXPECT_LT(filtered[i].n, whole[i].n) << i;
    EXPECT_EQ(filtered[i].points, whole[i].points);  // Before the filters.
    EXPECT_LT(DistanceM(filtered[i].T_world_lidar, TownDrive().T_world_lidar[i]), 0.08) << i;
  }
}

TEST_P(EveryMode, TakesEveryMetricAndRejection) {
  const auto expect_motion = [](const OdometryOptions& options, const std::string& what) {
    const auto results = Drive(options, FirstScans(4));
    for (std::size_t i = 1; i < results.size(); ++i) {
      EXPECT_TRUE(results[i].registered) << what << " " << i;
      EXPECT_GT(results[i].motion.t().x(), 0.01) << what << " " << i;  // Patches hold on.
      EXPECT_LT(DistanceM(results[i].motion, SE3d()), 1) << what << " " << i;
    }
  };
  OdometryOptions options;
  ForEachMetric([&](auto tag) {
    const std::string metric = decltype(tag)::Metric::kName;
    options = Options(GetParam(), {metric});
    options.preprocessing.voxel_m = NeedsFeatures(metric) ? 0 : 0.25;
    options.minimizer.max_iterations = 5;
    expect_motion(options, metric);
  });
  options = Options(GetParam(), {"point_to_point"});  // Normals that no metric needs.
  options.objective.matching.max_normal_angle_rad = 0.5;
  expect_motion(options, "normal angle");
  options = Options(GetParam());
  options.objective.matching.reciprocal_epsilon_m = 0.1;
  expect_motion(options, "reciprocal");
  options.objective.matching.kept_fraction = 0.7;
  expect_motion(options, "trimmed");
  options = Options(GetParam());
  options.objective.loss = MakeLoss("tolerant", 0.1);
  expect_motion(options, "tolerant");
  options = Options(GetParam());
  options.adaptive_gate_m = 0;
  options.minimizer.reassociation = Reassociation::kEveryEvaluation;
  expect_motion(options, "every evaluation");
}

TEST(Odometry, StartsFromTheMotionBefore) {
  OdometryOptions options = Options(OdometryMode::kScanToScan);
  options.adaptive_gate_m = 0;  // Which would help to forget a bad start.
  const auto constant_velocity = Drive(options, TownDrive().scans);
  options.constant_velocity = false;
  const auto none = Drive(options, TownDrive().scans);
  EXPECT_EQ(Bits(constant_velocity[1]), Bits(none[1]));  // No motion is known yet.
  for (std::size_t i = 2; i < none.size(); ++i) {
    EXPECT_LT(constant_velocity[i].iterations, none[i].iterations) << i;
    EXPECT_LT(DistanceM(constant_velocity[i].motion, none[i].motion), 0.03) << i;
  }
}

// Each step over again from the parts that it is made of: T_e is the motion before, and the gate
// is what KISS-ICP makes of the predictions' errors.
void ExpectTheChainOfItsParts(const OdometryOptions& options) {
  const std::vector<PointCloud> scans = FirstScans(4);
  const std::vector<FrameResult> results = Drive(options, scans);
  const auto prepare = [&](std::size_t i) {
    return Prepare(scans[i], kSourceNormal | kTargetNormal | kTargetLine | kTargetPatch,
                   options.preprocessing, 1);
  };
  AdaptiveGate gate(options.adaptive_gate_m);
  SE3d predicted, pose;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const auto source = prepare(i), target = prepare(i - 1);
    const FilteredPair pair =
        ApplyFilters(source->cloud, target->cloud, predicted, options.filters);
    ObjectiveSetOptions objective = options.objective;
    objective.matching.max_distance_m = gate.MaxDistance_m();
    objective.line.max_neighbor_distance_m = gate.MaxDistance_m();
    objective.patch.max_neighbor_distance_m = gate.MaxDistance_m();
    const ObjectiveSet set(pair.source, pair.target, source->features.Select(pair.keep_source),
                           options.metrics, objective);
    std::vector<JointObjective::Term> terms;
    for (const Objective& term : set.objectives()) {
      terms.push_back({&term, 1});
    }
    const MinimizerSummary summary =
        Minimize(JointObjective(std::move(terms)), predicted, options.minimizer);
    const SE3d found = summary.T_target_source().Normalized();
    EXPECT_EQ(results[i].gate_m, gate.MaxDistance_m());
    EXPECT_EQ(results[i].motion.Matrix(), found.Matrix()) << i;
    EXPECT_EQ(results[i].n, summary.iterates.back().n);
    EXPECT_EQ(results[i].rmse, summary.iterates.back().rmse);
    EXPECT_EQ(results[i].iterations, static_cast<int>(summary.iterates.size()) - 1);
    gate.Add(predicted, found);
    predicted = options.constant_velocity ? found : SE3d();
    pose = pose * found;
    EXPECT_LT((results[i].T_world_lidar.Matrix() - pose.Matrix()).norm(), 1e-12);
  }
}

TEST(Odometry, IsTheChainOfItsParts) {
  OdometryOptions options = Options(OdometryMode::kScanToScan, {"point_to_plane", "edge_to_line"});
  options.preprocessing.voxel_m = 0;
  ExpectTheChainOfItsParts(options);
  options.metrics = {"edge_to_line", "planar_to_plane"};
  options.adaptive_gate_m = 0.3;  // So tight that fits feel it.
  ExpectTheChainOfItsParts(options);
  options.constant_velocity = false;
  ExpectTheChainOfItsParts(options);
  options.metrics = {"edge_to_line", "point_to_plane"};
  options.filters.ego_blind_spot_m = 5;
  options.filters.octree_voxel_m = 0.5;
  ExpectTheChainOfItsParts(options);
}

TEST(Odometry, WeighsItsMetrics) {
  OdometryOptions options = Options(OdometryMode::kScanToScan);
  const auto planes = Drive(options, FirstScans(3));
  options.metrics = {"point_to_plane", "point_to_point"};
  options.weights = {1, 1e-15};
  const auto almost = Drive(options, FirstScans(3));
  options.weights = {};
  const auto both = Drive(options, FirstScans(3));
  EXPECT_LT(DistanceM(almost[2].T_world_lidar, planes[2].T_world_lidar), 1e-9);
  EXPECT_GT(DistanceM(both[2].T_world_lidar, planes[2].T_world_lidar), 1e-3);
}

// A map of one scan whose voxels hold a point at most is that scan.
TEST(Odometry, IsScanToScanWithAMapOfOneScan) {
  OdometryOptions options = Options(OdometryMode::kScanToMap);
  options.map = {1e-3, 1e4, 1};
  const auto map = Drive(options, FirstScans(5));
  const auto scan = Drive(Options(OdometryMode::kScanToScan), FirstScans(5));
  for (std::size_t i = 1; i < map.size(); ++i) {
    EXPECT_EQ(map[i].map_points, scan[i - 1].points);
    EXPECT_EQ(scan[i].map_points, 0U);
    EXPECT_LT(DistanceM(map[i].T_world_lidar, scan[i].T_world_lidar), 1e-4) << i;
  }
}

TEST(Odometry, KeepsTheMapThatItIsToldTo) {
  OdometryOptions options = Options(OdometryMode::kScanToMap);
  const auto points_of_map = [&](const LocalMapOptions& map) {
    options.map = map;
    return Drive(options, FirstScans(5)).back().map_points;
  };
  const std::size_t all = points_of_map({0.5, 80, 0});
  EXPECT_GT(all, points_of_map({1, 80, 0}));
  EXPECT_GT(all, points_of_map({0.5, 20, 0}));
  EXPECT_GT(all, points_of_map({0.5, 80, 2}));
  EXPECT_EQ(all, points_of_map({0.5, 80, 4}));
}

// The last scan's own points are no exception; and a stray point, too far away for any voxel, is
// left out instead of ending the drive.
TEST(Odometry, MapsNothingBeyondItsRadius) {
  OdometryOptions options = Options(OdometryMode::kScanToMap);
  options.preprocessing.voxel_m = 0;
  options.map = {1e-3, 20, 0};
  std::vector<PointCloud> scans = FirstScans(2);
  std::size_t within = 0;
  for (std::size_t i = 0; i < scans[0].size(); ++i) {
    within += scans[0].Point(i).norm() <= 20 ? 1 : 0;
  }
  ASSERT_LT(within, scans[0].size());
  const auto results = Drive(options, scans);
  EXPECT_EQ(results[1].map_points, within);
  for (PointCloud& scan : scans) {
    scan.x[0] = 1e6F;
  }
  for (const OdometryMode mode : {OdometryMode::kScanToMap, OdometryMode::kTwoStage}) {
    options.mode = mode;
    options.map_every = 1;
    EXPECT_TRUE(Drive(options, scans)[1].registered);
  }
}

// LOAM's mapping corrects poses at its own slow pace; the predictor follows the fast stage.
TEST(Odometry, MapsEveryFewScansInTwoStages) {
  OdometryOptions options = Options(OdometryMode::kTwoStage);
  options.map_every = 3;
  const auto two = Drive(options, TownDrive().scans);
  const auto one = Drive(Options(OdometryMode::kScanToScan), TownDrive().scans);
  for (std::size_t i = 1; i < two.size(); ++i) {
    const bool maps = i % 3 == 0;
    EXPECT_EQ(two[i].map_points > 0, maps) << i;
    // The fast stage is scan to scan, whatever the map says.
    EXPECT_EQ(two[i].motion.Matrix(), one[i].motion.Matrix()) << i;
    const SE3d without_map = (two[i - 1].T_world_lidar * two[i].motion).Normalized();
    EXPECT_EQ(two[i].T_world_lidar.Matrix() == without_map.Matrix(), !maps) << i;
  }
}

TEST(Odometry, RegistersToTheMapAloneWhereItMust) {
  OdometryOptions options = Options(OdometryMode::kTwoStage);
  options.map_every = 1;
  std::vector<PointCloud> scans = FirstScans(5);
  scans[3] = PointCloud();
  const auto results = Drive(options, scans);
  EXPECT_FALSE(results[3].registered);
  EXPECT_TRUE(results[4].registered);
  EXPECT_EQ(results[4].motion.Matrix(), results[3].motion.Matrix());  // Of the fast stage: none.
  EXPECT_LT(DistanceM(results[4].T_world_lidar, TownDrive().T_world_lidar[4]), 0.1);
}

// Rings of eight points have no edges, but are points among which others find lines.
TEST(Odometry, RegistersToTheScanAloneWhereItMust) {
  OdometryOptions options = Options(OdometryMode::kTwoStage, {"edge_to_line"});
  options.preprocessing.voxel_m = 0;
  options.map_every = 1;
  options.map.scans = 1;
  std::vector<PointCloud> scans = FirstScans(4);
  for (std::size_t i = 0; i < scans[2].size(); ++i) {
    scans[2].ring[i] = static_cast<std::int32_t>(i / 8);
  }
  const auto results = Drive(options, scans);
  EXPECT_FALSE(results[2].registered);
  EXPECT_EQ(results[3].map_points, 0U);
  EXPECT_TRUE(results[3].registered);
  EXPECT_NE(results[3].motion.Matrix(), results[2].motion.Matrix());
  EXPECT_EQ((results[2].T_world_lidar * results[3].motion).Normalized().Matrix(),
            results[3].T_world_lidar.Matrix());
}

// After 20 km, where a float is rounded to 2 mm, a drive goes on as at home.
TEST_P(EveryMode, IsPreciseFarFromHome) {
  const OdometryOptions options = Options(GetParam());
  const std::vector<PointCloud> scans = FirstScans(5);
  const auto home = Drive(options, scans);
  Odometry odometry(options);
  FrameResult first = home[0];
  first.T_world_lidar = SE3d(Mat3::Identity(), Vec3(20000, -15000, 500));
  odometry.Replay(scans[0], first);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const SE3d T_world_lidar = odometry.Add(scans[i]).T_world_lidar;
    EXPECT_LT(DistanceM(first.T_world_lidar * home[i].T_world_lidar, T_world_lidar), 2e-3) << i;
  }
}

TEST(Odometry, BeginsWithAnyFirstScan) {
  for (const OdometryMode mode : kModes) {
    std::vector<PointCloud> scans = FirstScans(5);
    scans[0] = PointCloud();
    const auto results = Drive(Options(mode), scans);
    EXPECT_FALSE(results[1].registered);  // There is nothing to register it to.
    EXPECT_TRUE(results[4].registered) << static_cast<int>(mode);
  }
}

TEST(Odometry, RefusesOptionsThatCannotGoTogether) {
  const auto message = [](const OdometryOptions& options) {
    return MessageOf<UsageError>([&] { const Odometry odometry(options); });
  };
  for (const OdometryMode mode : kModes) {
    OdometryOptions options = Options(mode, kLoam);
    options.filters.octree_voxel_m = 0.1;
    EXPECT_THAT(message(options), HasSubstr(mode == OdometryMode::kScanToScan
                                                ? "nothing was thrown"
                                                : "maps of edges and planar points are none"));
  }
  OdometryOptions options = Options(OdometryMode::kScanToMap);
  options.weights = {1, 2};
  EXPECT_THAT(message(options), HasSubstr("2 weights for 1 metrics"));
  options = Options(OdometryMode::kScanToMap);
  options.metrics = {"point_to_pint"};
  EXPECT_THAT(message(options), HasSubstr("point_to_pint"));
  options = Options(OdometryMode::kTwoStage);
  options.map_every = 0;
  EXPECT_THAT(message(options), HasSubstr("map_every is 0"));
  options = Options(OdometryMode::kScanToMap);
  options.minimizer.reassociation = Reassociation::kEveryEvaluation;
  EXPECT_THAT(message(options), HasSubstr("the adaptive gate rejects pairs"));
  options.adaptive_gate_m = 0;
  EXPECT_THAT(message(options), HasSubstr("nothing was thrown"));
}

TEST(Odometry, KnowsItsModesByName) {
  for (const OdometryMode mode : kModes) {
    EXPECT_EQ(OdometryModeFromName(kNames[static_cast<int>(mode)]), mode);
  }
  EXPECT_THAT(MessageOf<UsageError>([] { OdometryModeFromName("foo"); }),
              HasSubstr("expected one of scan_to_scan, scan_to_map, two_stage"));
}

}  // namespace
}  // namespace icpscape
