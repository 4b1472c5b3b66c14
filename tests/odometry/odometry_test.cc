// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/odometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "icpscape/common/error.h"
#include "icpscape/residuals/registry.h"
#include "tests/odometry/drives.h"
#include "tests/support/message_of.h"
#include "tests/support/prepared.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using namespace testing_support;  // NOLINT: the helpers of these tests, all of them.
using testing::HasSubstr;

TEST(Odometry, StartsFromTheMotionBefore) {
  OdometryOptions options = Options(OdometryMode::kScanToScan);
  options.adaptive_gate_m = 0;  // Which would help to forget a bad start.
  const auto constant_velocity = RunAll(options, TownDrive().scans);
  options.constant_velocity = false;
  const auto none = RunAll(options, TownDrive().scans);
  EXPECT_EQ(Bits(constant_velocity[1]), Bits(none[1]));  // No motion is known yet.
  for (std::size_t i = 2; i < none.size(); ++i) {
    EXPECT_LT(constant_velocity[i].iterations, none[i].iterations) << i;
    EXPECT_LT(DistanceM(constant_velocity[i].motion, none[i].motion), 0.03) << i;
  }
}

// Each step again from its parts: the predicted pose is the motion of the scan before, and the gate
// is KISS-ICP's, from the errors of the predicted poses.
void ExpectTheChainOfItsParts(const OdometryOptions& options) {
  const std::vector<PointCloud> scans = FirstScans(4);
  const std::vector<FrameResult> results = RunAll(options, scans);
  const auto prepare = [&](std::size_t i) {
    return Prepare(scans[i], kSourceNormal | kTargetNormal | kTargetLine | kTargetPatch,
                   options.preparation, 1);
  };
  AdaptiveGate gate(options.adaptive_gate_m);
  SE3d predicted, pose;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const PreparedScan source = prepare(i), target = prepare(i - 1);
    const KeptPoints kept =
        ApplyFilters(source.cloud(), target.cloud(), predicted, options.filters);
    ObjectiveSetOptions objective = options.objective;
    objective.matching.max_distance_m = gate.MaxDistance_m();
    objective.line.max_neighbor_distance_m = gate.MaxDistance_m();
    objective.patch.max_neighbor_distance_m = gate.MaxDistance_m();
    const ObjectiveSet set(testing_support::AsPrepared(source.cloud().Select(kept.source),
                                                       target.cloud().Select(kept.target),
                                                       source.features()->Select(kept.source)),
                           options.metrics, objective);
    const MinimizerSummary summary =
        Minimize(JointObjective(set.objectives(), {}), predicted, options.minimizer);
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
  options.preparation.voxel_m = 0;
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
  const auto planes = RunAll(options, FirstScans(3));
  options.metrics = {"point_to_plane", "point_to_point"};
  options.weights = {1, 1e-15};
  const auto almost = RunAll(options, FirstScans(3));
  options.weights = {};
  const auto both = RunAll(options, FirstScans(3));
  EXPECT_LT(DistanceM(almost[2].T_world_lidar, planes[2].T_world_lidar), 1e-9);
  EXPECT_GT(DistanceM(both[2].T_world_lidar, planes[2].T_world_lidar), 1e-3);
}

// A map of one scan whose voxels hold a point at most is that scan.
TEST(Odometry, IsScanToScanWithAMapOfOneScan) {
  OdometryOptions options = Options(OdometryMode::kScanToMap);
  options.map = {1e-3, 1e4, 1};
  const auto map = RunAll(options, FirstScans(5));
  const auto scan = RunAll(Options(OdometryMode::kScanToScan), FirstScans(5));
  for (std::size_t i = 1; i < map.size(); ++i) {
    EXPECT_EQ(map[i].map_points, scan[i - 1].points);
    EXPECT_EQ(scan[i].map_points, 0U);
    EXPECT_LT(DistanceM(map[i].T_world_lidar, scan[i].T_world_lidar), 1e-4) << i;
  }
}

// The estimate of the filters is the predicted motion, whatever the target is. Of 0.8 m a scan the
// voxels of half a metre would keep little without it.
TEST(Odometry, FiltersAMapOfOneScanAsTheScan) {
  OdometryOptions options = Options(OdometryMode::kScanToMap);
  options.map = {1e-3, 1e4, 1};
  options.filters.octree_voxel_m = 0.5;
  const auto map = RunAll(options, FirstScans(5));
  options.mode = OdometryMode::kScanToScan;
  const auto scan = RunAll(options, FirstScans(5));
  for (std::size_t i = 2; i < map.size(); ++i) {
    EXPECT_TRUE(map[i].registered);
    EXPECT_NEAR(static_cast<double>(map[i].n), static_cast<double>(scan[i].n),
                0.02 * static_cast<double>(scan[i].n))
        << i;
    EXPECT_LT(DistanceM(map[i].T_world_lidar, scan[i].T_world_lidar), 2e-3) << i;
  }
}

TEST(Odometry, KeepsTheMapOfItsOptions) {
  OdometryOptions options = Options(OdometryMode::kScanToMap);
  const auto points_of_map = [&](const LocalMapOptions& map) {
    options.map = map;
    return RunAll(options, FirstScans(5)).back().map_points;
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
  options.preparation.voxel_m = 0;
  options.map = {1e-3, 20, 0};
  std::vector<PointCloud> scans = FirstScans(2);
  std::size_t within = 0;
  for (std::size_t i = 0; i < scans[0].size(); ++i) {
    within += scans[0].Point(i).norm() <= 20 ? 1 : 0;
  }
  ASSERT_LT(within, scans[0].size());
  const auto results = RunAll(options, scans);
  EXPECT_EQ(results[1].map_points, within);
  for (PointCloud& scan : scans) {
    scan.x[0] = 1e6F;
  }
  for (const OdometryMode mode : {OdometryMode::kScanToMap, OdometryMode::kTwoStage}) {
    options.mode = mode;
    options.map_every = 1;
    EXPECT_TRUE(RunAll(options, scans)[1].registered);
  }
}

// LOAM's mapping corrects poses at its own slow pace; the predictor follows the fast stage.
TEST(Odometry, MapsEveryFewScansInTwoStages) {
  OdometryOptions options = Options(OdometryMode::kTwoStage);
  options.map_every = 3;
  const auto two = RunAll(options, TownDrive().scans);
  const auto one = RunAll(Options(OdometryMode::kScanToScan), TownDrive().scans);
  for (std::size_t i = 1; i < two.size(); ++i) {
    const bool maps = i % 3 == 0;
    EXPECT_EQ(two[i].map_points > 0, maps) << i;
    // The fast stage is scan to scan, whatever the map says.
    EXPECT_EQ(two[i].motion.Matrix(), one[i].motion.Matrix()) << i;
    const SE3d without_map = (two[i - 1].T_world_lidar * two[i].motion).Normalized();
    EXPECT_EQ(two[i].T_world_lidar.Matrix() == without_map.Matrix(), !maps) << i;
    // Pairs and RMSE are those of the last stage.
    EXPECT_EQ(two[i].n == one[i].n, !maps) << i;
    EXPECT_EQ(two[i].rmse == one[i].rmse, !maps) << i;
  }
}

// One iteration a stage: they are counted together. Voxels of a millimetre keep all points: those
// of the first scan alone, since scans that are not registered to the map do not go into it.
TEST(Odometry, CountsTheIterationsOfBothStagesAndMapsTheScansOfTheSecond) {
  OdometryOptions options = Options(OdometryMode::kTwoStage);
  options.map_every = 3;
  options.map = {1e-3, 1e4, 0};
  options.minimizer.max_iterations = 1;
  const auto results = RunAll(options, FirstScans(5));
  EXPECT_EQ(results[2].iterations, 1);
  EXPECT_EQ(results[3].iterations, 2);
  EXPECT_EQ(results[4].iterations, 1);
  EXPECT_EQ(results[3].map_points, results[0].points);
}

TEST(Odometry, SkipsAnEmptyScan) {
  OdometryOptions options = Options(OdometryMode::kTwoStage);
  options.map_every = 1;
  std::vector<PointCloud> scans = FirstScans(5);
  scans[3] = PointCloud();
  const auto results = RunAll(options, scans);
  EXPECT_FALSE(results[3].registered);
  EXPECT_TRUE(results[4].registered);
  // The empty scan is skipped: the fast stage goes on from the one before it.
  EXPECT_NE(results[4].motion.Matrix(), results[3].motion.Matrix());
  EXPECT_LT(DistanceM(results[4].T_world_lidar, TownDrive().T_world_lidar[4]), 0.1);
}

// Rings of eight points have no edges, but are points among which others find lines.
TEST(Odometry, SkipsAScanWithoutEdges) {
  OdometryOptions options = Options(OdometryMode::kTwoStage, {"edge_to_line"});
  options.preparation.voxel_m = 0;
  options.map_every = 1;
  options.map.scans = 1;
  std::vector<PointCloud> scans = FirstScans(4);
  for (std::size_t i = 0; i < scans[2].size(); ++i) {
    scans[2].ring[i] = static_cast<std::int32_t>(i / 8);
  }
  const auto results = RunAll(options, scans);
  EXPECT_FALSE(results[2].registered);
  EXPECT_GT(results[3].map_points, 0U);  // It did not take the place of the scan before.
  EXPECT_TRUE(results[3].registered);
  EXPECT_LT(DistanceM(results[3].T_world_lidar, TownDrive().T_world_lidar[3]), 0.2);
}

TEST(Odometry, BeginsWithAnyFirstScan) {
  for (const OdometryMode mode : kModes) {
    std::vector<PointCloud> scans = FirstScans(5);
    scans[0] = PointCloud();
    const auto results = RunAll(Options(mode), scans);
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
                                                : "edges and planar points are matched to maps"));
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
    EXPECT_EQ(FromName<OdometryMode>(kNames[static_cast<int>(mode)]), mode);
  }
  EXPECT_THAT(MessageOf<UsageError>([] { FromName<OdometryMode>("foo"); }),
              HasSubstr("expected one of scan_to_scan, scan_to_map, two_stage"));
}

}  // namespace
}  // namespace icpscape
