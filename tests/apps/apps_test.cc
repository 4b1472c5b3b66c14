// SPDX-License-Identifier: BSD-3-Clause
// The programs as users run them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "icpscape/common/text.h"
#include "icpscape/io/point_files.h"
#include "icpscape/io/transform.h"
#include "tests/apps/apps_fixture.h"
#include "tests/support/real_scans.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;
using Apps = testing_support::AppsFixture;
using testing_support::TemporaryFolder;

TEST_F(Apps, LandscapeWritesTablesFiguresAndManifest) {
  const Outcome outcome = RunProgram("landscape", Files({"--samples=31"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ground-truth check"));
  const auto rows = ReadCsv(Path("out/curves.csv"));
  ASSERT_EQ(rows.size(), 3U * 31U);
  std::map<std::string, std::pair<double, double>> minima;  // rmse, u
  for (const auto& row : rows) {
    const double rmse = std::stod(row.at("rmse"));
    auto [it, is_new] = minima.try_emplace(row.at("metric"), rmse, std::stod(row.at("u")));
    if (!is_new && rmse < it->second.first) {
      it->second = {rmse, std::stod(row.at("u"))};
    }
    EXPECT_NEAR(rmse, std::sqrt(2 * std::stod(row.at("cost")) / std::stod(row.at("n"))), 1e-12);
  }
  EXPECT_NEAR(minima["point_to_plane"].second, 1, 0.11);
  EXPECT_NEAR(minima["symmetric"].second, 1, 0.11);
  const auto manifest = nlohmann::json::parse(ReadFile(Path("out/manifest.json")));
  EXPECT_EQ(manifest["flags"]["samples"], "31");
  EXPECT_EQ(manifest["inputs"].size(), 3U);
  EXPECT_TRUE(manifest["timings_s"].contains("landscape"));
  EXPECT_THAT(ReadFile(Path("out/landscape.svg")), HasSubstr("</svg>"));
  EXPECT_THAT(ReadFile(Path("out/landscape.png")), testing::StartsWith("\x89PNG"));
  EXPECT_THAT(ReadFile(Path("out/symmetric_rmse.txt")), testing::StartsWith("u rmse\n-1 "));
}

TEST_F(Apps, LandscapeIsTheSameForAnyNumberOfThreads) {
  ASSERT_EQ(RunProgram("landscape", Files({"--samples=11", "--threads=1"})).code, 0);
  const std::string one = ReadFile(Path("out/curves.csv"));
  ASSERT_EQ(RunProgram("landscape", Files({"--samples=11", "--threads=2"})).code, 0);
  EXPECT_EQ(one, ReadFile(Path("out/curves.csv")));
}

TEST_F(Apps, RegisterFindsTheMotionAndItsCostIsTheLandscapes) {
  const Outcome outcome = RunProgram("register", Files({"--starts=10"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("10 of 10 succeed"));
  const SE3d T = ReadTransform(Path("out/T_target_source.txt"));
  const SE3d off = ReadTransform(Path("truth.txt")).Inverse() * T;
  EXPECT_LT(off.t().norm(), 0.02);
  DroppedPoints dropped;
  EXPECT_EQ(ReadPointFile(Path("out/aligned.ply"), &dropped).size(), 3000U);
  const auto iterates = ReadCsv(Path("out/iterates.csv"));
  const std::string cost = iterates.back().at("cost");
  EXPECT_THAT(outcome.out, HasSubstr("final cost: " + cost));
  EXPECT_EQ(ReadCsv(Path("out/starts.csv")).size(), 10U);
  // The landscape at the same pose: u = 1 of a path that ends there.
  auto arguments = Files({"--samples=2", "--u_min=0", "--u_max=1", "--metrics=point_to_plane"});
  arguments[2] = "--ground_truth=" + Path("out/T_target_source.txt");
  arguments[3] = "--out=" + Path("out2");
  ASSERT_EQ(RunProgram("landscape", arguments).code, 0);
  const double landscape = std::stod(ReadCsv(Path("out2/curves.csv")).back().at("cost"));
  EXPECT_NEAR(landscape, std::stod(cost), 1e-12 * landscape);
}

TEST_F(Apps, RegisterFollowsItsStopRulesAndDirections) {
  ASSERT_EQ(RunProgram("register", Files({"--dof=yaw,x"})).code, 0);
  const SE3d T = ReadTransform(Path("out/T_target_source.txt"));
  EXPECT_NE(T.LogRotation().z(), 0);
  EXPECT_NEAR(T.LogRotation().head<2>().norm(), 0, 1e-12);
  EXPECT_NEAR(T.t().z(), 0, 1e-12);
  const Outcome stopped = RunProgram("register", Files({"--max_final_cost=1e6"}));
  EXPECT_THAT(stopped.out, HasSubstr("cost_reached: The cost is at most 1e+06."));
  EXPECT_EQ(ReadCsv(Path("out/iterates.csv")).size(), 1U);
  const Outcome hardly = RunProgram("register", Files({"--min_cost_change=0.9"}));
  EXPECT_THAT(hardly.out, HasSubstr("cost_change: "));
}

TEST_F(Apps, RefinedReferenceIsWhereTheClosedLoopEnds) {
  // A truth that is 10 cm off; refined, u = 1 is where point-to-plane ends (under the check's
  // gate).
  const SE3d truth = ReadTransform(Path("truth.txt"));
  folder_.Write("off.txt", FormatTransform(SE3d(truth.R(), truth.t() + Vec3(0, 0.1, 0))));
  const auto rmse_at_1 = [&](const std::string& reference) {
    EXPECT_EQ(RunProgram("landscape", Files({"--ground_truth=" + Path("off.txt"), "--samples=2",
                                             "--u_min=0", "--u_max=1", "--metrics=point_to_plane",
                                             "--reference=" + reference}))
                  .code,
              0);
    return std::stod(ReadCsv(Path("out/curves.csv")).back().at("rmse"));
  };
  const double given = rmse_at_1("ground_truth");
  const auto manifest = nlohmann::json::parse(ReadFile(Path("out/manifest.json")));
  EXPECT_NEAR(manifest["results"]["ground_truth_check_m"].get<double>(), 0.1, 0.02);
  EXPECT_LT(rmse_at_1("refined"), 0.9 * given);
}

TEST_F(Apps, FrozenMatchesAreThoseOfTheirU) {
  const auto cost_at_0 = [&](const std::vector<std::string>& more) {
    auto arguments = Files({"--samples=2", "--u_min=0", "--u_max=1", "--metrics=point_to_point"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(RunProgram("landscape", arguments).code, 0);
    return std::stod(ReadCsv(Path("out/curves.csv")).front().at("cost"));
  };
  const double reassociated = cost_at_0({});
  EXPECT_EQ(cost_at_0({"--association=frozen", "--frozen_u=0"}), reassociated);
  EXPECT_GT(cost_at_0({"--association=frozen", "--frozen_u=1"}), reassociated);
}

TEST_F(Apps, InitialPoseIsTheStartAndLossIsUsed) {
  const auto first_cost = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(RunProgram("register", Files(more)).code, 0);
    return std::stod(ReadCsv(Path("out/iterates.csv")).front().at("cost"));
  };
  const double from_identity = first_cost({});
  EXPECT_LT(first_cost({"--initial=" + Path("truth.txt")}), 0.2 * from_identity);
  EXPECT_LT(first_cost({"--loss=huber", "--loss_scale_m=0.01"}), 0.5 * from_identity);
}

TEST_F(Apps, OffsetIsMeasuredAlongThePath) {
  // From a start that is the truth less 10 cm the whole path is 10 cm long.
  const SE3d truth = ReadTransform(Path("truth.txt"));
  folder_.Write("near.txt", FormatTransform(SE3d(truth.R(), truth.t() - Vec3(0.1, 0, 0))));
  const Outcome outcome =
      RunProgram("landscape", Files({"--initial=" + Path("near.txt"), "--samples=7", "--u_min=-2",
                                     "--u_max=0", "--metrics=point_to_plane"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("0.0000         0.1000"));
}

// Point-to-point needs no normals, the limit on their angle does. It leaves out pairs across edges.
TEST_F(Apps, NormalAngleBringsItsNormals) {
  const auto pairs = [&](const std::vector<std::string>& more) {
    auto arguments = Files({"--metrics=point_to_point"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = RunProgram("register", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return std::stol(ReadCsv(Path("out/iterates.csv")).back().at("n"));
  };
  EXPECT_EQ(pairs({}), 3000);
  const long within = pairs({"--max_normal_angle_deg=30"});
  EXPECT_LT(within, 3000);
  EXPECT_GT(within, 2000);
}

// The truth of frame 0 to frame 1 is the inverse of the fixture's.
TEST_F(Apps, FrameZeroHasNoPriorButATarget) {
  const Outcome outcome =
      RunProgram("landscape", Kitti({"--frame=0", "--target_frame=1", "--metrics=point_to_plane"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("000000.bin, 3000 points\ntarget: "));
  const auto rows = ReadCsv(Path("out/curves.csv"));  // u = -1, 0, 1, 2.
  ASSERT_EQ(rows.size(), 4U);
  for (const auto& row : rows) {
    EXPECT_GE(std::stod(row.at("rmse")), std::stod(rows[2].at("rmse"))) << row.at("u");
  }
  ExpectRefusal(RunProgram("landscape",
                           Kitti({"--frame=0", "--target_frame=1", "--initial=previous_motion"})),
                1, "expected true poses, and a scan before each of the two");
}

TEST_F(Apps, CapsRecoverTheRingsTheyNeed) {
  const Outcome outcome =
      RunProgram("landscape", {"--scene=right_turn", "--samples=2", "--azimuth_step_deg=1",
                               "--metrics=planar_to_plane", "--smoothness_neighborhood=k_nearest",
                               "--feature_caps=loam", "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  // LOAM's: four regions of each of 64 rings, with two edges and four planar points at most.
  const auto manifest = nlohmann::json::parse(ReadFile(Path("out/manifest.json")));
  const std::size_t edges = manifest["results"]["edge_points"];
  const std::size_t planar = manifest["results"]["planar_points"];
  EXPECT_LE(edges, 64U * 4U * 2U);
  EXPECT_LE(planar, 64U * 4U * 4U);
  EXPECT_GT(planar, 64U * 4U * 3U);
}

TEST_F(Apps, ReverseGoesTheOtherWay) {
  const Outcome outcome = RunProgram("register", Files({"--reverse"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const SE3d T = ReadTransform(Path("out/T_target_source.txt"));
  const SE3d truth = ReadTransform(Path("truth.txt")).Inverse();
  EXPECT_LT((truth.Inverse() * T).t().norm(), 0.02);
  EXPECT_GT((truth.Inverse() * SE3d()).t().norm(), 0.2);
}

TEST_F(Apps, SeveralMetricsAreMinimisedTogether) {
  const Outcome outcome = RunProgram(
      "register",
      Files({"--metrics=point_to_plane,symmetric", "--weights=1,0.25", "--accept=limit,cycle"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const double joint = std::stod(ReadCsv(Path("out/iterates.csv")).front().at("cost"));
  const auto single = [&](const std::string& metric) {
    EXPECT_EQ(RunProgram("register", Files({"--metrics=" + metric})).code, 0);
    return std::stod(ReadCsv(Path("out/iterates.csv")).front().at("cost"));
  };
  const double expected = single("point_to_plane") + 0.25 * single("symmetric");
  EXPECT_NEAR(joint, expected, 1e-12 * expected);
}

TEST_F(Apps, FiltersAndFeaturesOfAScene) {
  const Outcome outcome = RunProgram(
      "landscape", {"--scene=highway_overtaking", "--samples=4", "--out=" + Path("out"),
                    "--metrics=point_to_point,edge_to_line,planar_to_patch,planar_to_plane",
                    "--artificial_blind_spot_m=5", "--ego_filter_m=5", "--octree_voxel_m=0.1",
                    "--reciprocal", "--path=bicycle"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* says : {"edge points", "artificial_blind_spot: keeps", "ego_filter: keeps",
                           "octree_filter: keeps"}) {
    EXPECT_THAT(outcome.out, HasSubstr(says));
  }
  EXPECT_EQ(ReadCsv(Path("out/curves.csv")).size(), 16U);
}

TEST_F(Apps, VoxelCentroidsFindTheMotion) {
  const Outcome outcome =
      RunProgram("register", {"--scene=right_turn", "--voxel_m=0.25", "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string says = "off the ground truth: ";
  ASSERT_THAT(outcome.out, HasSubstr(says));
  std::istringstream off(outcome.out.substr(outcome.out.find(says) + says.size()));
  double off_m = 1, off_deg = 1;
  std::string unit;
  off >> off_m >> unit >> off_deg;
  EXPECT_LT(off_m, 0.02);
  EXPECT_LT(off_deg, 0.1);
  const auto manifest = nlohmann::json::parse(ReadFile(Path("out/manifest.json")));
  const std::size_t points = manifest["results"]["source_points"];
  const std::size_t centroids = manifest["results"]["voxel_filter_source_points"];
  EXPECT_GT(points, 100000U);
  EXPECT_LT(centroids, points / 3);
  EXPECT_THAT(outcome.out, HasSubstr("voxel_filter: leaves " + std::to_string(centroids) +
                                     " of the source's " + std::to_string(points) + " points"));
  EXPECT_TRUE(manifest["results"].contains("voxel_filter_target_points"));
  DroppedPoints dropped;
  EXPECT_EQ(ReadPointFile(Path("out/aligned.ply"), &dropped).size(), centroids);
}

TEST_F(Apps, VoxelsComeBeforeFiltersAndIntoTheTitle) {
  const Outcome outcome =
      RunProgram("landscape", {"--scene=highway_overtaking", "--samples=2", "--azimuth_step_deg=1",
                               "--voxel_m=0.5", "--octree_voxel_m=0.5", "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LT(outcome.out.find("voxel_filter: leaves"), outcome.out.find("octree_filter: keeps"));
  EXPECT_THAT(ReadFile(Path("out/landscape.svg")), HasSubstr("-voxel_m=0.5"));
}

TEST_F(Apps, GroundTruthCheckWithoutAnAnswerIsNoFailure) {
  PointCloud sparse;  // No pair within the check's gate.
  for (int i = 0; i < 100; ++i) {
    testing_support::AddPoint(Vec3(5.0 * (i % 10), 5.0 * (i / 10), 0.5 * (i % 3)), &sparse);
  }
  WritePly(Path("target.ply"), sparse);
  for (float& x : sparse.x) {
    x += 2.5F;
  }
  WritePly(Path("source.ply"), sparse);
  folder_.Write("truth.txt", FormatTransform(SE3d(Mat3::Identity(), Vec3(0.0, 0.5, 0.0))));
  for (const char* app : {"landscape", "register"}) {
    const Outcome outcome = RunProgram(app, Files({"--metrics=point_to_point"}));
    // So few points half a grid apart leave the pose doubtful, whatever the check says.
    EXPECT_EQ(outcome.code, app == std::string("register") ? 4 : 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("ground-truth check: no answer"));
  }
}

TEST_F(Apps, RobustPresetReachesTheMotionFromFarAndRefusesItsOwnFlags) {
  const Outcome far = RunProgram(
      "register", Files({"--preset=robust", "--starts=20", "--start_m=1", "--start_deg=15"}));
  EXPECT_EQ(far.code, 0) << far.err;
  EXPECT_THAT(far.out, HasSubstr("20 of 20 succeed"));
  EXPECT_GE(ReadCsv(Path("out/stages.csv")).size(), 4U);
  for (const char* flag : {"--max_distance_m=1", "--loss=huber", "--loss_scale_m=0.2",
                           "--reassociation=every_evaluation"}) {
    testing_support::ExpectRefusal(RunProgram("register", Files({"--preset=robust", flag})), 1,
                                   "its default with --preset=robust");
  }
  testing_support::ExpectRefusal(
      RunProgram("register", Files({"--preset=robust", "--metrics=edge_to_line"})), 1,
      "edge or planar points");
  testing_support::ExpectRefusal(RunProgram("register", Files({"--preset=fast"})), 1,
                                 "paper, robust");
}

TEST_F(Apps, FlagfileWorks) {
  folder_.Write("flags", "--samples=5\n--metrics=symmetric\n");
  ASSERT_EQ(RunProgram("landscape", Files({"--flagfile=" + Path("flags")})).code, 0);
  EXPECT_EQ(ReadCsv(Path("out/curves.csv")).size(), 5U);
}

TEST(AppsListMetrics, NamesAll) {
  const Outcome outcome = RunProgram("list_metrics", {});
  EXPECT_EQ(outcome.code, 0);
  for (const char* name : {"point_to_point", "point_to_plane", "symmetric_rotated", "two_plane"}) {
    EXPECT_THAT(outcome.out, HasSubstr(name));
  }
}

TEST(AppsRealData, LastCostOfRegisterIsTheLandscapesOn0095) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::filesystem::path root = KittiRoot();
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  const std::vector<std::string> kitti = {"--kitti_root=" + root.string(), "--frame=95"};
  for (const std::string metric : {"point_to_plane", "symmetric"}) {
    auto arguments = kitti;
    arguments.insert(arguments.end(), {"--metrics=" + metric, "--out=" + out});
    ASSERT_EQ(RunProgram("register", arguments).code, 0);
    const double cost = std::stod(ReadCsv(out + "/iterates.csv").back().at("cost"));
    const std::string scans = root.string() + "/sequences/00/velodyne/0000";
    ASSERT_EQ(
        RunProgram("landscape", {"--source=" + scans + "95.bin", "--target=" + scans + "94.bin",
                                 "--ground_truth=" + out + "/T_target_source.txt", "--u_min=0",
                                 "--u_max=1", "--samples=2", "--metrics=" + metric, "--out=" + out})
            .code,
        0);
    const double landscape = std::stod(ReadCsv(out + "/curves.csv").back().at("cost"));
    EXPECT_NEAR(landscape, cost, 1e-12 * cost);
  }
}

}  // namespace
}  // namespace icpscape
