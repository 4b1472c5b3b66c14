// SPDX-License-Identifier: BSD-3-Clause
// Every program reads every source of scans: files, folders, raw drives, KITTI's layout and
// simulated scans; a pair is two frames of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "icpscape/io/point_files.h"
#include "icpscape/io/transform.h"
#include "icpscape/simulation/simulated_sequence.h"
#include "tests/apps/apps_fixture.h"
#include "tests/support/point_file_writer.h"
#include "tests/support/run_program.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadFile;
using testing_support::RunProgram;

class Sources : public testing_support::AppsFixture {
 protected:
  Sources() {
    // The fixture's KITTI scans once more, as a folder and as a raw drive, behind another scan.
    const std::filesystem::path scans = Path("kitti/sequences/00/velodyne");
    for (const char* folder : {"folder", "raw/velodyne_points/data"}) {
      std::filesystem::create_directories(Path(folder));
      const std::filesystem::path into = Path(folder);
      std::filesystem::copy(scans / "000001.bin", into / "0000000003.bin");
      std::filesystem::copy(scans / "000000.bin", into / "0000000004.bin");
      std::filesystem::copy(scans / "000001.bin", into / "0000000007.bin");
    }
  }

  // The registered pose, as text.
  std::string Register(std::vector<std::string> arguments) const {
    arguments.push_back("--out=" + Path("registered"));
    const Outcome outcome = RunProgram("register", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return ReadFile(Path("registered/T_target_source.txt"));
  }
};

TEST_F(Sources, RegisterTakesTwoFramesOfAny) {
  const std::string expected = Register({"--kitti_root=" + Path("kitti"), "--frame=1"});
  EXPECT_EQ(Register({"--scans=" + Path("folder"), "--frame=2"}), expected);
  EXPECT_EQ(Register({"--scans=" + Path("raw"), "--frame=2"}), expected);
  EXPECT_EQ(Register({"--scans=" + Path("raw"), "--frame=0", "--target_frame=1"}), expected);
  EXPECT_EQ(Register({"--scans=" + Path("raw"), "--frame=1", "--target_frame=2", "--reverse"}),
            expected);
  EXPECT_EQ(Register({"--source=" + Path("folder/0000000007.bin"),
                      "--target=" + Path("folder/0000000004.bin")}),
            expected);
}

TEST_F(Sources, LandscapeTakesTwoFramesOfAFolderWithItsTrajectory) {
  const Outcome kitti = RunProgram("landscape", Kitti());
  ASSERT_EQ(kitti.code, 0) << kitti.err;
  const std::string curves = ReadFile(Path("out/curves.csv"));
  std::string poses = ReadFile(Path("kitti/poses/00.txt"));
  const std::string second = poses.substr(poses.find('\n') + 1);
  folder_.Write("trajectory.txt", second + poses);  // As the scans: the second comes first.
  const std::vector<std::string> folder = {"--scans=" + Path("folder"), "--frame=2", "--samples=4",
                                           "--out=" + Path("out")};
  ExpectRefusal(RunProgram("landscape", folder), 1, "no ground truth: expected --ground_truth");
  std::vector<std::string> with_truth = folder;
  with_truth.push_back("--ground_truth=" + Path("trajectory.txt"));
  const Outcome outcome = RunProgram("landscape", with_truth);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(ReadFile(Path("out/curves.csv")), curves);
}

TEST_F(Sources, OdometryDrivesThroughASceneAsThroughItsFiles) {
  const std::vector<std::string> lidar = {"--azimuth_step_deg=1.5", "--seed=3"};
  std::vector<std::string> simulate = lidar, direct = lidar;
  simulate.insert(simulate.end(), {"--scene=right_turn", "--out=" + Path("simulated")});
  ASSERT_EQ(RunProgram("simulate", simulate).code, 0);
  direct.insert(direct.end(), {"--scene=right_turn", "--out=" + Path("direct")});
  const Outcome outcome = RunProgram("odometry", direct);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("3 scans"));
  ASSERT_EQ(RunProgram("odometry", {"--kitti_root=" + Path("simulated"), "--sequence=right_turn",
                                    "--out=" + Path("files")})
                .code,
            0);
  EXPECT_EQ(ReadFile(Path("direct/trajectory_tum.txt")),
            ReadFile(Path("files/trajectory_tum.txt")));
}

TEST_F(Sources, ADriveIsASourceOfPairs) {
  const Outcome outcome =
      RunProgram("register", {"--scene=town", "--frame=40", "--target_frame=38",
                              "--azimuth_step_deg=1.5", "--out=" + Path("town")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ground truth: exact"));
  ExpectRefusal(RunProgram("register", {"--scene=town", "--out=" + Path("town")}), 1,
                "no --frame: expected the number of the scan");
}

// Points in the order in which the lasers fire form no rings, but the field of the file does.
TEST_F(Sources, RingsOfAFileServeFeatures) {
  LidarOptions lidar;
  lidar.azimuth_step_deg = 0.72;
  const ScanPair pair = SimulatePair("right_turn", 3, lidar, 2);
  const auto write = [&](const PointCloud& cloud, const std::string& name, bool with_ring) {
    std::vector<std::size_t> order(cloud.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Once around, from the x axis.
    const auto column = [&](std::size_t i) { return M_PI + std::atan2(-cloud.y[i], -cloud.x[i]); };
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return column(a) < column(b); });
    std::vector<testing_support::TestField> fields = {{"x"}, {"y"}, {"z"}};
    if (with_ring) {
      fields.push_back({"ring", 'U', 2});
    }
    folder_.Write(name, testing_support::PcdFile(
                            fields, static_cast<int>(cloud.size()),
                            [&](const testing_support::TestField& field, int i, int) -> double {
                              const std::size_t at = order[static_cast<std::size_t>(i)];
                              return field.name == "ring" ? cloud.ring[at]
                                                          : cloud.Point(at)[field.name[0] - 'x'];
                            },
                            "binary"));
  };
  for (const bool with_ring : {false, true}) {
    write(pair.source, "source.pcd", with_ring);
    write(pair.target, "target.pcd", with_ring);
    const Outcome outcome =
        RunProgram("register", {"--source=" + Path("source.pcd"), "--target=" + Path("target.pcd"),
                                "--metrics=edge_to_line,planar_to_plane", "--out=" + Path("out"),
                                "--accept=limit,cycle,undetermined"});
    if (!with_ring) {
      ExpectRefusal(outcome, 2, "the points form 1 ring by their azimuth");
      continue;
    }
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const SE3d T = ReadTransform(Path("out/T_target_source.txt"));
    const SE3d off = pair.T_ground_truth->Inverse() * T;
    EXPECT_LT(off.t().norm(), 0.1);
    EXPECT_GT(pair.T_ground_truth->t().norm(), 0.4);
  }
}

// A scan's normals, the check of the ground truth and the matching share one search.
TEST_F(Sources, APairIsReadPreparedAndRegisteredWithOneSearchPerScan) {
  for (const char* metric : {"point_to_point", "point_to_plane", "symmetric"}) {
    const Outcome outcome =
        RunProgram("register", {"--kitti_root=" + Path("kitti"), "--frame=1",
                                std::string("--metrics=") + metric, "--out=" + Path("out")});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("ground-truth check"));
    const auto manifest = nlohmann::json::parse(ReadFile(Path("out/manifest.json")));
    EXPECT_EQ(manifest["results"]["searches_built"], 2) << metric;
  }
}

// The same scans, told in frames whose origin is elsewhere. lerp_slerp is the path of the sensor,
// so that the curves are the same if and only if its place is told as well.
TEST_F(Sources, TheSensorIsWhereItIsSaidToBe) {
  const SE3d shift(Mat3::Identity(), Vec3(256, -128, 32));
  DroppedPoints dropped;
  for (const char* name : {"source", "target"}) {
    const std::string file = std::string(name) + ".ply";
    WritePly(Path("far_" + file), ReadPointFile(Path(file), &dropped).Transformed(shift));
  }
  folder_.Write("far_truth.txt",
                FormatTransform(shift * ReadTransform(Path("truth.txt")) * shift.Inverse()));
  const auto rmse = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(),
                     {"--samples=4", "--metrics=point_to_point", "--out=" + Path("out")});
    const Outcome outcome = RunProgram("landscape", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::vector<double> values;
    for (const auto& row : testing_support::ReadCsv(Path("out/curves.csv"))) {
      values.push_back(std::stod(row.at("rmse")));
    }
    return values;
  };
  const std::vector<std::string> far = {"--source=" + Path("far_source.ply"),
                                        "--target=" + Path("far_target.ply"),
                                        "--ground_truth=" + Path("far_truth.txt")};
  std::vector<std::string> with_sensor = far;
  with_sensor.push_back("--sensor_origin=256,-128,32");
  const std::vector<double> here = rmse(Files()), told = rmse(with_sensor), untold = rmse(far);
  ASSERT_EQ(here.size(), 4U);
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_NEAR(told[i], here[i], 1e-4 * here[i]) << i;
  }
  EXPECT_GT(std::abs(untold[0] - here[0]), 0.05 * here[0]);

  ExpectRefusal(RunProgram("register", Files({"--sensor_origin=1,2"})), 1,
                "--sensor_origin=1,2: expected three numbers");
  ExpectRefusal(RunProgram("register", {"--scene=right_turn", "--sensor_origin=1,2,3"}), 1,
                "no --sensor_origin with it");
}

}  // namespace
}  // namespace icpscape
