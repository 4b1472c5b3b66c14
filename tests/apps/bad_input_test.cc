// SPDX-License-Identifier: BSD-3-Clause
// Each error of a command line or its data gives one sentence and an exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/apps/apps_fixture.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadFile;
using testing_support::RunProgram;
using BadInput = testing_support::AppsFixture;

TEST_F(BadInput, WrongCommandLines) {
  ExpectRefusal(RunProgram("landscape", {}), 1, "expected --scene=NAME, or --kitti_root=DIR");
  ExpectRefusal(RunProgram("landscape", Files({"stray"})), 1, "stray argument \"stray\"");
  ExpectRefusal(RunProgram("landscape", Files({"--nonsense=1"})), 1, "nonsense");
  ExpectRefusal(RunProgram("landscape", Files({"--samples=1"})), 1,
                "samples 1: expected at least 2");
  ExpectRefusal(RunProgram("landscape", Files({"--u_min=2", "--u_max=2"})), 1,
                "expected u_min below");
  ExpectRefusal(RunProgram("landscape", Files({"--metrics=point_to_pint"})), 1,
                "expected one of point_to_point, point_to_plane, symmetric");
  ExpectRefusal(RunProgram("landscape", Files({"--metrics="})), 1, "expected at least one metric");
  ExpectRefusal(RunProgram("landscape", Files({"--path=spline"})), 1, "lerp_slerp, geodesic");
  ExpectRefusal(RunProgram("landscape", Files({"--normal_neighbors=2"})), 1, "expected at least 3");
  ExpectRefusal(RunProgram("landscape", Files({"--max_distance_m=-1"})), 1,
                "expected a number of at least 0");
  ExpectRefusal(RunProgram("landscape", Files({"--threads=-2"})), 1, "--threads=-2");
  ExpectRefusal(RunProgram("landscape", Files({"--kitti_root=x"})), 1,
                "expected no --scene, --kitti_root");
  ExpectRefusal(RunProgram("landscape", {"--kitti_root=x", "--frame=0"}), 1,
                "no scan comes before it");
  ExpectRefusal(RunProgram("landscape", {"--kitti_root=x"}), 1, "no --frame");
  ExpectRefusal(RunProgram("landscape", Files({"--metrics=symmetric,,two_plane"})), 1,
                "single commas");
  ExpectRefusal(RunProgram("register", Files({"--loss=hubert"})), 1, "none, huber");
  ExpectRefusal(RunProgram("register", Files({"--loss_scale_m=0", "--loss=huber"})), 1,
                "expected 1e-6 to 1e6");
  ExpectRefusal(RunProgram("landscape", Files({"--loss_scale_m=1e-200", "--loss=tolerant"})), 1,
                "expected 1e-6 to 1e6");
  ExpectRefusal(RunProgram("landscape", Files({"--frozen_u=nan"})), 1, "--frozen_u");
  ExpectRefusal(RunProgram("landscape", Files({"--samples=2000000000"})), 1, "at most 1e6");
  ExpectRefusal(RunProgram("landscape", Files({"--u_min=-1e308"})), 1, "within 1e6");
  ExpectRefusal(RunProgram("landscape", Files({"--out="})), 1, "--out=: expected a folder");
  ExpectRefusal(RunProgram("landscape", Files({"--metrics=symmetric,symmetric"})), 1,
                "each metric");
  ExpectRefusal(RunProgram("landscape", Kitti({"--target_frame=1"})), 1, "another scan");
  ExpectRefusal(RunProgram("register", Files({"--start_m=inf"})), 1, "--start_m=inf");
  ExpectRefusal(
      RunProgram("register", Files({"--reassociation=every_evaluation", "--max_distance_m=1"})), 1,
      "expected every_step where pairs are rejected");
  ExpectRefusal(RunProgram("register", Files({"--weights=1,2"})), 1, "one weight per metric");
  ExpectRefusal(RunProgram("register", Files({"--weights=inf"})), 1, "positive numbers");
  ExpectRefusal(RunProgram("register", Files({"--dof=sideways"})), 1, "roll");
  ExpectRefusal(RunProgram("register", Files({"--dof="})), 1, "planar");
  ExpectRefusal(RunProgram("register", Files({"--min_cost_change=1"})), 1, "below 1");
  ExpectRefusal(RunProgram("register", Files({"--max_final_cost=nan"})), 1, "at least 0");
  ExpectRefusal(
      RunProgram("register", Files({"--reassociation=every_evaluation", "--metrics=edge_to_line"})),
      1, "fitted");
  ExpectRefusal(RunProgram("landscape", Files({"--max_normal_angle_deg=200"})), 1, "at most 180");
  ExpectRefusal(RunProgram("landscape", Files({"--region_median_factor=-2"})), 1, "positive");
  ExpectRefusal(RunProgram("landscape", Files({"--filter_estimate=ground_thruth"})), 1,
                "identity, ground_truth or a file");
  ExpectRefusal(RunProgram("filter_bias", Files({"--loss=cauchy"})), 1, "--loss=cauchy");
  ExpectRefusal(RunProgram("register", Files({"--reassociation=never"})), 1, "every_step");
  ExpectRefusal(RunProgram("register", Files({"--max_iterations=0"})), 1, "--max_iterations");
  ExpectRefusal(RunProgram("landscape", Files({"--voxel_m=-1"})), 1, "a length in m, or 0");
  ExpectRefusal(RunProgram("register", Files({"--voxel_m=inf"})), 1, "a length in m, or 0");
  const std::vector<std::string> no_files = {"--source=no.ply", "--target=no.ply",
                                             "--ground_truth=no.txt", "--voxel_m=0.25"};
  for (const char* app : {"landscape", "register", "filter_bias"}) {
    auto features = no_files;
    features.push_back("--metrics=point_to_point,planar_to_patch");
    ExpectRefusal(RunProgram(app, features), 1, "--voxel_m=0.25: expected 0 with planar_to_patch");
  }
  ExpectRefusal(RunProgram("filter_bias", no_files), 1, "centroids have no labels");
  auto no_truth = Files({"--starts=5"});
  no_truth.erase(no_truth.begin() + 2);
  ExpectRefusal(RunProgram("register", no_truth), 1, "no ground truth: expected --ground_truth");
  no_truth.back() = "--samples=5";
  ExpectRefusal(RunProgram("landscape", no_truth), 1, "no ground truth: expected --ground_truth");
  EXPECT_FALSE(std::filesystem::exists(Path("out/curves.csv")));
}

TEST_F(BadInput, UnknownSimdLevels) {
  setenv("ICPSCAPE_SIMD", "sse9", 1);
  ExpectRefusal(RunProgram("landscape", {"--scene=highway"}), 1,
                "ICPSCAPE_SIMD=sse9: expected one of baseline");
  unsetenv("ICPSCAPE_SIMD");
}

TEST_F(BadInput, BrokenData) {
  auto files = Files();
  files[0] = "--source=" + Path("nothing.ply");
  ExpectRefusal(RunProgram("landscape", files), 2, "nothing.ply: cannot be read");
  folder_.Write("scaled.txt", "2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1");
  files = Files({"--ground_truth=" + Path("scaled.txt")});
  ExpectRefusal(RunProgram("landscape", files), 2, "scaled.txt: the matrix is not rigid");
  folder_.Write("file", "");
  ExpectRefusal(RunProgram("landscape", Files({"--out=" + Path("file")})), 2, "expected a folder");

  ExpectRefusal(RunProgram("landscape", Kitti({"--sequence=77"})), 2,
                "sequences/77: no such folder");
  ExpectRefusal(RunProgram("landscape", Kitti({"--frame=2"})), 2,
                "velodyne: no scan 2 among 2 scans");
  const std::string scan = "kitti/sequences/00/velodyne/000001.bin";
  const std::string whole = ReadFile(Path(scan));
  folder_.Write(scan, whole.substr(0, 1000));
  ExpectRefusal(RunProgram("landscape", Kitti()), 2, "1000 bytes; expected a multiple of 16");
  folder_.Write(scan, "");
  ExpectRefusal(RunProgram("landscape", Kitti()), 2, "no usable point among 0");
  folder_.Write(scan, whole);
  folder_.Write("kitti/sequences/00/calib.txt", "P0: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  ExpectRefusal(RunProgram("landscape", Kitti()), 2, "no line begins with \"Tr:\"");
  folder_.Write("kitti/sequences/00/calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  ExpectRefusal(RunProgram("landscape", Kitti({"--voxel_m=1e-9"})), 2,
                "within 2^20 voxels of 1e-09");
  EXPECT_FALSE(std::filesystem::exists(Path("out/curves.csv")));
}

TEST_F(BadInput, NanPointsAreDroppedAndCounted) {
  PointCloud cloud = testing_support::Room(3000, 2);
  cloud.x[5] = NAN;
  cloud.x[6] = cloud.y[6] = cloud.z[6] = 0;
  WriteBin("kitti/sequences/00/velodyne/000001.bin", cloud);
  const Outcome outcome = RunProgram("landscape", Kitti());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2998 points (dropped: 1 not finite, 1 at the origin)"));
}

TEST_F(BadInput, NoCorrespondenceLeft) {
  ExpectRefusal(RunProgram("landscape", Files({"--max_distance_m=1e-9"})), 3,
                "no correspondence is left for");
  ExpectRefusal(RunProgram("register", Files({"--max_distance_m=1e-9"})), 3,
                "No pair of points is left");
  EXPECT_FALSE(std::filesystem::exists(Path("out/T_target_source.txt")));
}

TEST_F(BadInput, SimulationsStayAwayFromMeasuredData) {
  const std::string poses = ReadFile(Path("kitti/poses/00.txt"));
  ExpectRefusal(RunProgram("simulate", {"--scene=highway", "--out=" + Path("kitti")}), 2,
                "not simulated here");
  std::filesystem::remove_all(Path("kitti/sequences/00/velodyne"));
  ExpectRefusal(RunProgram("simulate", {"--kitti_root=" + Path("kitti"), "--sequence=00",
                                        "--frames=0:1", "--out=" + Path("kitti")}),
                2, "not simulated here");
  EXPECT_EQ(ReadFile(Path("kitti/poses/00.txt")), poses);
  // A drive of 30 cm has a street as well.
  const Outcome outcome =
      RunProgram("simulate", {"--kitti_root=" + Path("kitti"), "--sequence=00",
                              "--azimuth_step_deg=2", "--out=" + Path("drive")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("00: 2 scans simulated, 0 kept\n"));
  EXPECT_GT(std::filesystem::file_size(Path("drive/sequences/00/velodyne/000001.bin")), 16000U);
}

}  // namespace
}  // namespace icpscape
