// SPDX-License-Identifier: BSD-3-Clause
// Every flag arrives where it belongs, in the library's units; and without flags the programs do
// what the library does by default.
#include <ceres/loss_function.h>
#include <gflags/gflags.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "apps/flags/features.h"
#include "apps/flags/filters.h"
#include "apps/flags/lidar.h"
#include "apps/flags/minimizer.h"
#include "apps/flags/objective.h"
#include "apps/flags/odometry.h"
#include "apps/flags/preparation.h"
#include "apps/flags/sensor.h"
#include "icpscape/common/error.h"
#include "icpscape/objective/loss.h"

namespace icpscape {
namespace {

constexpr double kDegree = M_PI / 180;

// Flags are set for one test.
class Flags : public testing::Test {
 protected:
  static void Set(const std::vector<std::pair<const char*, const char*>>& flags) {
    for (const auto& [name, value] : flags) {
      ASSERT_NE(gflags::SetCommandLineOption(name, value), "") << name;
    }
  }

 private:
  gflags::FlagSaver saver_;
};

TEST_F(Flags, OfTheMinimizer) {
  Set({{"metrics", "point_to_plane"},
       {"reassociation", "every_evaluation"},
       {"max_iterations", "7"},
       {"min_step_m", "0.25"},
       {"min_step_deg", "3"},
       {"min_cost_change", "0.125"},
       {"max_final_cost", "11"},
       {"dof", "pitch,yaw,z"},
       {"threads", "3"}});
  const MinimizerOptions options = MinimizerFromFlags();
  EXPECT_EQ(options.reassociation, Reassociation::kEveryEvaluation);
  EXPECT_EQ(options.max_iterations, 7);
  EXPECT_EQ(options.min_step_m, 0.25);
  EXPECT_NEAR(options.min_step_rad, 3 * kDegree, 1e-15);
  EXPECT_EQ(options.min_cost_change, 0.125);
  EXPECT_EQ(options.max_final_cost, 11);
  EXPECT_EQ(options.free, (DofMask{false, true, true, false, false, true}));
  EXPECT_EQ(options.threads, 3);
  Set({{"dof", "planar"}});
  EXPECT_EQ(MinimizerFromFlags().free, (DofMask{false, false, true, true, true, false}));
}

TEST_F(Flags, OfTheMatching) {
  Set({{"max_distance_m", "2.5"},
       {"reciprocal_epsilon_m", "0.75"},
       {"max_normal_angle_deg", "40"},
       {"max_median_factor", "6"},
       {"kept_fraction", "0.625"},
       {"region_size_m", "8"},
       {"region_median_factor", "5"}});
  EXPECT_FALSE(ObjectiveSetFromFlags().matching.reciprocal_epsilon_m);  // Not without --reciprocal.
  Set({{"reciprocal", "true"}});
  const MatchingOptions options = ObjectiveSetFromFlags().matching;
  EXPECT_EQ(options.max_distance_m, 2.5);
  EXPECT_EQ(options.reciprocal_epsilon_m, 0.75);
  EXPECT_NEAR(options.max_normal_angle_rad, 40 * kDegree, 1e-15);
  EXPECT_EQ(options.max_median_factor, 6);
  EXPECT_EQ(options.kept_fraction, 0.625);
  ASSERT_TRUE(options.regions);
  EXPECT_EQ(options.regions->region_size_m, 8);
  EXPECT_EQ(options.regions->median_factor, 5);
}

TEST_F(Flags, OfFitsAndLoss) {
  Set({{"fit_neighbors", "9"},
       {"fit_eigenvalue_ratio", "2.25"},
       {"fit_max_smallest_eigenvalue_m2", "0.5"},
       {"fit_eigenvalue_scale", "over_n_minus_one"},
       {"fit_anchor", "nearest"},
       {"fit_max_neighbor_distance_m", "1.5"},
       {"patch_leg_m", "0.375"},
       {"loss", "huber"},
       {"loss_scale_m", "0.2"}});
  const ObjectiveSetOptions options = ObjectiveSetFromFlags();
  for (const LocalFitOptions& fit : {options.line, options.patch}) {
    EXPECT_EQ(fit.num_neighbors, 9);
    EXPECT_EQ(fit.eigenvalue_ratio, 2.25);
    EXPECT_EQ(fit.max_smallest_eigenvalue_m2, 0.5);
    EXPECT_EQ(fit.eigenvalue_scale, EigenvalueScale::kOverNMinusOne);
    EXPECT_EQ(fit.anchor, FitAnchor::kNearest);
    EXPECT_EQ(fit.max_neighbor_distance_m, 1.5);
    EXPECT_EQ(fit.triangle_leg_m, 0.375);
  }
  // Huber's of a residual of 1 m, bent at 0.2 m: 2 * 0.2 * 1 - 0.2^2.
  double rho[3];
  options.loss->Evaluate(1, rho);
  EXPECT_NEAR(rho[0], 0.36, 1e-12);
}

TEST_F(Flags, OfFeatures) {
  Set({{"smoothness", "lio_sam"},
       {"smoothness_neighborhood", "radius"},
       {"ring_points_per_side", "4"},
       {"smoothness_neighbors", "13"},
       {"smoothness_radius_m", "0.875"},
       {"feature_caps", "a_loam_less_sharp"}});
  FeatureOptions options = FeaturesFromFlags();
  EXPECT_EQ(options.smoothness.formula, SmoothnessFormula::kLioSam);
  EXPECT_EQ(options.smoothness.neighborhood, SmoothnessNeighborhood::kRadius);
  EXPECT_EQ(options.smoothness.ring_points_per_side, 4);
  EXPECT_EQ(options.smoothness.num_neighbors, 13);
  EXPECT_EQ(options.smoothness.radius_m, 0.875);
  EXPECT_EQ(options.edge_from, 1);  // LIO-SAM's.
  EXPECT_EQ(options.planar_below, 0.1);
  EXPECT_EQ(options.caps.regions_per_ring, 6);
  EXPECT_EQ(options.caps.edges_per_region, 20);
  EXPECT_EQ(options.caps.planar_per_region, 4);
  Set({{"planar_below", "0.3"}, {"edge_from", "0.4"}});
  options = FeaturesFromFlags();
  EXPECT_EQ(options.planar_below, 0.3);
  EXPECT_EQ(options.edge_from, 0.4);
}

TEST_F(Flags, OfPreparationFiltersAndLidar) {
  Set({{"elevation_correction_deg", "0.205"},
       {"voxel_m", "0.125"},
       {"normal_neighbors", "11"},
       {"normal_radius_m", "0.625"},
       {"artificial_blind_spot_m", "3"},
       {"ego_filter_m", "6"},
       {"octree_voxel_m", "0.2"},
       {"azimuth_step_deg", "0.5"},
       {"range_noise_m", "0.03"},
       {"ring_bias_m", "0.04"},
       {"dropout", "0.25"},
       {"seed", "17"}});
  const PreparationOptions options = PreparationFromFlags({"point_to_plane"});
  EXPECT_EQ(options.elevation_correction_deg, 0.205);
  EXPECT_EQ(options.voxel_m, 0.125);
  EXPECT_EQ(options.normals.num_neighbors, 11);
  EXPECT_EQ(options.normals.radius_m, 0.625);
  EXPECT_EQ(FiltersFromFlags().artificial_blind_spot_m, 3);
  EXPECT_EQ(FiltersFromFlags().ego_blind_spot_m, 6);
  EXPECT_EQ(FiltersFromFlags().octree_voxel_m, 0.2);
  EXPECT_EQ(LidarFromFlags().azimuth_step_deg, 0.5);
  EXPECT_EQ(LidarFromFlags().range_noise_m, 0.03);
  EXPECT_EQ(LidarFromFlags().ring_bias_m, 0.04);
  EXPECT_EQ(LidarFromFlags().dropout, 0.25);
  EXPECT_EQ(SeedFromFlags(), 17U);
}

// In the coordinates of the files, from which a far origin was taken out when they were read.
TEST_F(Flags, OfTheSensor) {
  const auto sensor_of_scan = [] {
    ScanSequence sequence;
    sequence.scans.push_back({"0.pcd", "", [](DroppedPoints* /*dropped*/) {
                                PointCloud cloud;
                                cloud.sensor = {7, 7, 7};
                                cloud.origin = {1000, -2000, 0};
                                return cloud;
                              }});
    PlaceSensors(&sequence);
    return sequence.scans[0].read(nullptr).sensor;
  };
  EXPECT_FALSE(SensorFromFlags());
  EXPECT_EQ(sensor_of_scan(), Vec3(7, 7, 7));
  Set({{"sensor_origin", "1001.5,-2,0.25"}});
  EXPECT_EQ(*SensorFromFlags(), Vec3(1001.5, -2, 0.25));
  EXPECT_EQ(sensor_of_scan(), Vec3(1.5, 1998, 0.25));
  for (const char* wrong : {"1", "1,2,x", "1,2,3,4", "1,2,nan"}) {
    Set({{"sensor_origin", wrong}});
    EXPECT_THROW(SensorFromFlags(), UsageError) << wrong;
  }
}

TEST_F(Flags, OfTheOdometry) {
  Set({{"metrics", "point_to_plane,symmetric"},
       {"weights", "2,0.5"},
       {"mode", "two_stage"},
       {"map_voxel_m", "0.75"},
       {"map_radius_m", "60"},
       {"map_scans", "4"},
       {"map_every", "3"},
       {"prediction", "none"},
       {"adaptive_gate_m", "1.5"}});
  const OdometryOptions options = OdometryFromFlags();
  EXPECT_EQ(options.mode, OdometryMode::kTwoStage);
  EXPECT_EQ(options.metrics, (std::vector<std::string>{"point_to_plane", "symmetric"}));
  EXPECT_EQ(options.weights, (std::vector<double>{2, 0.5}));
  EXPECT_EQ(options.map.voxel_m, 0.75);
  EXPECT_EQ(options.map.radius_m, 60);
  EXPECT_EQ(options.map.scans, 4);
  EXPECT_EQ(options.map_every, 3);
  EXPECT_FALSE(options.constant_velocity);
  EXPECT_EQ(options.adaptive_gate_m, 1.5);
}

// scan_to_map comes with a voxel filter, an adaptive gate and a loss, where they are not given.
TEST_F(Flags, OfTheModeHaveTheirOwnDefaults) {
  const auto value = [](const char* name) {
    return gflags::GetCommandLineFlagInfoOrDie(name).current_value;
  };
  Set({{"mode", "scan_to_scan"}});
  SetDefaultsOfMode();
  EXPECT_EQ(value("voxel_m") + " " + value("adaptive_gate_m") + " " + value("loss"), "0 0 none");
  Set({{"mode", "scan_to_map"}, {"adaptive_gate_m", "3"}});
  SetDefaultsOfMode();
  EXPECT_EQ(value("voxel_m") + " " + value("adaptive_gate_m") + " " + value("loss"),
            "0.25 3 huber");
}

TEST_F(Flags, OfScanToMapKeepWholeScansForFeatures) {
  Set({{"mode", "scan_to_map"}, {"metrics", "edge_to_line"}});
  SetDefaultsOfMode();
  EXPECT_EQ(gflags::GetCommandLineFlagInfoOrDie("voxel_m").current_value, "0");
  EXPECT_EQ(gflags::GetCommandLineFlagInfoOrDie("adaptive_gate_m").current_value, "2");
}

TEST_F(Flags, AreTheLibrarysDefaultsWhereNoneIsGiven) {
  const MinimizerOptions minimizer = MinimizerFromFlags();
  EXPECT_EQ(minimizer.reassociation, MinimizerOptions().reassociation);
  EXPECT_EQ(minimizer.max_iterations, MinimizerOptions().max_iterations);
  EXPECT_EQ(minimizer.min_step_m, MinimizerOptions().min_step_m);
  EXPECT_EQ(minimizer.min_cost_change, MinimizerOptions().min_cost_change);
  EXPECT_EQ(minimizer.max_final_cost, MinimizerOptions().max_final_cost);
  EXPECT_EQ(minimizer.free, MinimizerOptions().free);
  const ObjectiveSetOptions objective = ObjectiveSetFromFlags();
  EXPECT_FALSE(objective.matching.Rejects());
  EXPECT_EQ(objective.loss, nullptr);
  for (const LocalFitOptions& fit : {objective.line, objective.patch}) {
    EXPECT_EQ(fit.num_neighbors, LocalFitOptions().num_neighbors);
    EXPECT_EQ(fit.eigenvalue_ratio, LocalFitOptions().eigenvalue_ratio);
    EXPECT_EQ(fit.max_smallest_eigenvalue_m2, LocalFitOptions().max_smallest_eigenvalue_m2);
    EXPECT_EQ(fit.eigenvalue_scale, LocalFitOptions().eigenvalue_scale);
    EXPECT_EQ(fit.anchor, LocalFitOptions().anchor);
    EXPECT_EQ(fit.max_neighbor_distance_m, LocalFitOptions().max_neighbor_distance_m);
    EXPECT_EQ(fit.triangle_leg_m, LocalFitOptions().triangle_leg_m);
  }
  const PreparationOptions preparation = PreparationFromFlags({"point_to_plane"});
  EXPECT_EQ(preparation.normals.num_neighbors, NeighborhoodOptions().num_neighbors);
  EXPECT_EQ(preparation.normals.radius_m, NeighborhoodOptions().radius_m);
  const SmoothnessOptions smoothness = FeaturesFromFlags().smoothness;
  EXPECT_EQ(smoothness.ring_points_per_side, SmoothnessOptions().ring_points_per_side);
  EXPECT_EQ(smoothness.num_neighbors, SmoothnessOptions().num_neighbors);
  EXPECT_EQ(smoothness.radius_m, SmoothnessOptions().radius_m);
  EXPECT_FALSE(FiltersFromFlags().Any());
  const OdometryOptions odometry = OdometryFromFlags();
  EXPECT_EQ(odometry.mode, OdometryOptions().mode);
  EXPECT_EQ(odometry.map.voxel_m, LocalMapOptions().voxel_m);
  EXPECT_EQ(odometry.map.radius_m, LocalMapOptions().radius_m);
  EXPECT_EQ(odometry.map.scans, LocalMapOptions().scans);
  EXPECT_EQ(odometry.map_every, OdometryOptions().map_every);
  EXPECT_EQ(odometry.constant_velocity, OdometryOptions().constant_velocity);
}

}  // namespace
}  // namespace icpscape
