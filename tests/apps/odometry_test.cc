// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/file.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "icpscape/io/point_files.h"
#include "icpscape/io/trajectory.h"
#include "tests/apps/odometry_fixture.h"

namespace icpscape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing_support::DistanceM;
using testing_support::ExpectRefusal;
using testing_support::kProgram;
using testing_support::kScans;
using testing_support::OdometryApp;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;
using testing_support::ScanName;
using testing_support::TemporaryFolder;
using testing_support::TheDrive;

TEST_F(OdometryApp, WritesWhatTheJournalHas) {
  without_figures_.reset();
  const Outcome outcome = Run();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");  // No progress where there is no terminal.
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("KITTI 05: 12 scans, 000000.bin to 000011.bin"),
                                 HasSubstr("off the ground truth after 8.8 m"),
                                 Not(HasSubstr("could not be registered"))));
  const std::vector<FrameRecord> records = Journal();
  const Trajectory kitti = ReadTrajectory(Path("out/trajectory_kitti.txt"));
  const Trajectory tum = ReadTrajectory(Path("out/trajectory_tum.txt"));
  const auto frames = ReadCsv(Path("out/frames.csv"));
  ASSERT_EQ(records.size(), static_cast<std::size_t>(kScans));
  ASSERT_EQ(kitti.T_world_body.size(), records.size());
  ASSERT_EQ(tum.T_world_body.size(), records.size());
  ASSERT_EQ(frames.size(), records.size());
  ASSERT_EQ(ReadCsv(Path("out/timings.csv")).size(), records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const SE3d& T = records[i].result.T_world_lidar;
    EXPECT_LT(DistanceM(T, TheDrive().T_world_lidar[i]), 0.05) << i;
    EXPECT_LT((tum.T_world_body[i].Matrix() - T.Matrix()).norm(), 1e-12) << i;
    EXPECT_EQ(tum.times_s[i], times_s_[i]);
    // KITTI's poses are the camera's, in the frame of the first camera.
    const Mat<double, 4, 4> camera = Tr_.Matrix() * T.Matrix() * Tr_.Matrix().inverse();
    EXPECT_LT((kitti.T_world_body[i].Matrix() - camera).norm(), 1e-12) << i;
    auto row = frames[i];
    EXPECT_EQ(row["frame"], std::to_string(i));
    EXPECT_EQ(row["scan"], ScanName(static_cast<int>(i)));
    EXPECT_EQ(std::stod(row["time_s"]), times_s_[i]);
    EXPECT_EQ(row["registered"], i == 0 ? "0" : "1");
    EXPECT_EQ(row["termination"], i == 0 ? "first" : "converged");
    EXPECT_EQ(std::stod(row["x_m"]), T.t().x());
    EXPECT_EQ(std::stod(row["z_m"]), T.t().z());
    EXPECT_EQ(std::stol(row["n"]), records[i].result.n);
    EXPECT_EQ(std::stod(row["motion_m"]), records[i].result.motion.t().norm());
  }
  for (const char* figure : {"out/trajectory.svg", "out/trajectory.png"}) {
    EXPECT_TRUE(std::filesystem::exists(Path(figure))) << "needs Python with matplotlib";
  }
  const auto manifest = nlohmann::json::parse(ReadFile(Path("out/manifest.json")));
  EXPECT_EQ(manifest["flags"]["loss"], "huber");  // What comes with the mode is recorded.
  EXPECT_EQ(manifest["results"]["not_registered"], 0);
  const SE3d& end = records.back().result.T_world_lidar;
  EXPECT_LT(manifest["results"]["end_off_m"], 0.05);
  EXPECT_NEAR(manifest["results"]["end_off_deg"],
              (TheDrive().T_world_lidar.back().Inverse() * end).LogRotation().norm() * 180 / M_PI,
              1e-9);
}

TEST_F(OdometryApp, WritesAMapOfOnePointAVoxel) {
  ASSERT_EQ(Run({"--write_map_voxel_m=1", "--frames=0:3"}).code, 0);
  DroppedPoints dropped;
  const PointCloud map = ReadPointFile(Path("out/map.ply"), &dropped);
  std::set<std::array<double, 3>> voxels;
  for (std::size_t i = 0; i < map.size(); ++i) {
    voxels.insert({std::floor(map.x[i]), std::floor(map.y[i]), std::floor(map.z[i])});
  }
  EXPECT_EQ(voxels.size(), map.size());
  EXPECT_GT(map.size(), 2000U);
  std::filesystem::remove(Path("out/map.ply"));
  ASSERT_EQ(Run({"--write_map_voxel_m=0", "--frames=0:3"}).code, 0);  // It may differ.
  EXPECT_FALSE(std::filesystem::exists(Path("out/map.ply")));
}

TEST_F(OdometryApp, NamesTheScanThatHasNoRings) {
  const std::string scan = ReadFile(Path(Scan(3)));
  std::string shuffled;
  for (std::size_t i = 0; i < 1000; ++i) {
    shuffled += scan.substr((i * 7919) % (scan.size() / 16) * 16, 16);
  }
  folder_.Write(Scan(3), shuffled);
  const std::string loam = "--metrics=edge_to_line,planar_to_plane";
  ExpectRefusal(Run({loam, "--frames=3:5"}), 2, "000003.bin: the points form");
  const Outcome outcome = Run({loam, "--frames=1:5"}, "later");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("frame 2: the points form"));
  EXPECT_THAT(outcome.out, HasSubstr("could not be registered and keep the predicted pose"));
}

TEST_F(OdometryApp, RefusesMissingData) {
  ExpectRefusal(Run({"--sequence=77"}), 2, "sequences/77: no such folder");
  ExpectRefusal(Run({"--frames=10:12"}), 2, "velodyne: 12 scans; expected frames within 0:11.");
  const auto scans = [&](const std::string& name, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"--scans=" + Path(name), "--out=" + Path("out")});
    return RunProgram("odometry", more);
  };
  ExpectRefusal(scans("missing"), 2, "missing: no scan; expected a folder");
  std::filesystem::create_directories(Path("empty"));
  ExpectRefusal(scans("empty"), 2, "empty: no scan; expected a folder");
  const std::string velodyne = "kitti/sequences/05/velodyne";
  ExpectRefusal(scans(velodyne, {"--frames=7:12"}), 2, "12 scans; expected frames within 0:11");
  ExpectRefusal(scans(velodyne, {"--ground_truth=" + Path("missing.txt")}), 2,
                "missing.txt: cannot be read");
  folder_.Write("short.txt", FormatTransformRow(SE3d()) + "\n");
  ExpectRefusal(scans(velodyne, {"--ground_truth=" + Path("short.txt")}), 2,
                "short.txt: 1 poses; expected one for each of the 12 scans");
  folder_.Write("out/journal.txt", "a diary\n");
  ExpectRefusal(scans(velodyne), 2, "journal.txt:1: damaged");
  EXPECT_EQ(ReadFile(Path("out/journal.txt")), "a diary\n");
}

// Before any file is read: there is none.
TEST(OdometryCommandLine, IsRefusedWhereItIsWrong) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  const auto refuse = [&](std::vector<std::string> flags, const std::string& says) {
    flags.insert(flags.end(), {"--kitti_root=no_data", "--out=" + out});
    ExpectRefusal(RunProgram("odometry", flags), 1, says);
  };
  refuse({"--mode=foo"}, "expected one of scan_to_scan, scan_to_map, two_stage");
  refuse({"--map_voxel_m=0"}, "--map_voxel_m=0: expected a positive length");
  refuse({"--map_radius_m=-1"}, "--map_radius_m=-1: expected a positive length");
  refuse({"--map_scans=-1"}, "--map_scans=-1: expected 0 or more");
  refuse({"--map_every=0"}, "--map_every=0: expected at least 1");
  refuse({"--adaptive_gate_m=nan"}, "--adaptive_gate_m=nan: expected a length in m, or 0");
  refuse({"--write_map_voxel_m=-1"}, "--write_map_voxel_m=-1: expected a number of at least 0");
  refuse({"--deskew=maybe"}, "expected one of auto, on, off");
  refuse({"--prediction=crystal_ball"}, "expected one of constant_velocity, none");
  refuse({"--frames=5:1"}, "--frames=5:1: expected FIRST:LAST with 0 <= FIRST <= LAST");
  refuse({"--scans=no_scans"}, "expected one of --scene=NAME, --kitti_root=DIR and --scans=DIR.");
  refuse({"--ground_truth=a.txt"}, "--ground_truth=a.txt: expected --scans with it");
  refuse({"--metrics=edge_to_line", "--voxel_m=0.25"},
         "--voxel_m=0.25: expected 0 with edge_to_line");
  refuse({"--metrics=edge_to_line", "--octree_voxel_m=0.1"},
         "edges and planar points are matched to maps");
  refuse({"--metrics=point_to_pint"}, "expected one of point_to_point");
  refuse({"--weights=1,2"}, "--weights=1,2: expected one weight per metric");
  refuse({"--reassociation=every_evaluation", "--adaptive_gate_m=2"},
         "adaptive gate rejects pairs");
  refuse({"--max_iterations=0"}, "--max_iterations");
  refuse({"stray"}, "stray argument \"stray\"");
  ExpectRefusal(RunProgram("odometry", {"--scene=town", "--timestamps=a.txt", "--out=" + out}), 1,
                "--timestamps=a.txt: expected --scans or --kitti_root with it");
  ExpectRefusal(RunProgram("odometry", {}), 1, "expected one of --scene=NAME");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(OdometryApp, TakesOneScan) {
  const Outcome outcome = Run({"--frames=4:4"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Trajectory tum = ReadTrajectory(Path("out/trajectory_tum.txt"));
  ASSERT_EQ(tum.T_world_body.size(), 1U);
  EXPECT_EQ(tum.T_world_body[0].Matrix(), SE3d().Matrix());
  EXPECT_EQ(tum.times_s[0], times_s_[4]);
  EXPECT_EQ(ReadCsv(Path("out/frames.csv")).size(), 1U);
}

// Scans as PLY, out of the order of their names, with a TUM trajectory, and driven backwards.
TEST_F(OdometryApp, TakesAFolderOfScans) {
  std::filesystem::create_directories(Path("drive"));
  Trajectory truth;
  for (std::size_t i = 0; i < 4; ++i) {
    WritePly(Path("drive/" + std::to_string(8 + i) + ".ply"), TheDrive().scans[i]);
    truth.T_world_body.push_back(SE3d(Mat3::Identity(), Vec3(7, 8, 9)) *
                                 TheDrive().T_world_lidar[i]);
    truth.times_s.push_back(static_cast<double>(i));
  }
  WriteTumTrajectory(Path("truth.txt"), truth);
  const Outcome outcome =
      RunProgram("odometry", {"--scans=" + Path("drive"), "--ground_truth=" + Path("truth.txt"),
                              "--frames=1:3", "--reverse", "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("drive reversed: 3 scans, 11.ply to 9.ply\n"),
                                 HasSubstr("times: none, taken as 10 Hz\n")));
  const std::vector<SE3d> poses = ReadTrajectory(Path("out/trajectory_kitti.txt")).T_world_body;
  ASSERT_EQ(poses.size(), 3U);  // Without a camera the poses are the lidar's.
  const SE3d expected = TheDrive().T_world_lidar[3].Inverse() * TheDrive().T_world_lidar[1];
  EXPECT_LT(DistanceM(poses[2], expected), 0.03);
  EXPECT_LT(poses[2].t().x(), -1);  // Backwards.
  EXPECT_LT(nlohmann::json::parse(ReadFile(Path("out/manifest.json")))["results"]["end_off_m"],
            0.03);
}

// Sorted byte by byte, 10 to 12 come before 2, and the path is more than twice as long.
TEST_F(OdometryApp, TakesNamesInNaturalOrder) {
  std::filesystem::create_directories(Path("drive"));
  Trajectory truth;
  for (std::size_t i = 0; i < kScans; ++i) {
    WritePly(Path("drive/scan_" + std::to_string(i + 1) + ".ply"), TheDrive().scans[i]);
    truth.T_world_body.push_back(TheDrive().T_world_lidar[i]);
    truth.times_s.push_back(static_cast<double>(i));
  }
  folder_.Write("drive/.1234.scan_3.ply", "not yet whole");
  WriteTumTrajectory(Path("truth.txt"), truth);
  const Outcome outcome = RunProgram(
      "odometry",
      {"--scans=" + Path("drive"), "--ground_truth=" + Path("truth.txt"), "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("12 scans, scan_1.ply to scan_12.ply"), HasSubstr("path: 8.8 m")));
  EXPECT_LT(nlohmann::json::parse(ReadFile(Path("out/manifest.json")))["results"]["end_off_m"],
            0.05);
}

// Scans in the coordinates of a map: poses are in these, and so is the map that is written.
TEST_F(OdometryApp, ScansFarOutKeepTheirWorld) {
  const Vec3 origin(458000, 5429000, 100);
  std::filesystem::create_directories(Path("drive"));
  for (std::size_t i = 0; i < 3; ++i) {
    PointCloud scan = TheDrive().scans[i];
    scan.origin = origin;
    WritePly(Path("drive/" + std::to_string(i) + ".ply"), scan);
  }
  const Outcome outcome =
      RunProgram("odometry", {"--scans=" + Path("drive"), "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<SE3d> poses = ReadTrajectory(Path("out/trajectory_tum.txt")).T_world_body;
  ASSERT_EQ(poses.size(), 3U);
  const SE3d expected = TheDrive().T_world_lidar[0].Inverse() * TheDrive().T_world_lidar[2];
  EXPECT_LT((poses[2] * origin - origin - expected.t()).norm(), 0.03);
  EXPECT_NEAR(std::stod(ReadCsv(Path("out/frames.csv"))[2].at("y_m")), poses[2].t().y(), 1e-6);
  DroppedPoints dropped;
  const PointCloud map = ReadPointFile(Path("out/map.ply"), &dropped);
  EXPECT_LT((map.origin - origin).norm(), 100);
}

TEST_F(OdometryApp, TakesFoldersOfAnyName) {
  std::filesystem::create_directories(Path("a drive;\nwith = \"signs\""));
  WritePly(Path("a drive;\nwith = \"signs\"/0.ply"), TheDrive().scans[0]);
  for (const bool again : {false, true}) {
    const Outcome outcome = RunProgram(
        "odometry", {"--scans=" + Path("a drive;\nwith = \"signs\""), "--out=" + Path("out")});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("journal: 1 scans are done, and are replayed") != std::string::npos,
              again);
    EXPECT_EQ(ReadCsv(Path("out/frames.csv")).size(), 1U);
  }
}

// What the program shows on a terminal.
std::string RunOnTerminal(const std::vector<std::string>& arguments) {
  int terminal = -1;
  const pid_t pid = forkpty(&terminal, nullptr, nullptr, nullptr);
  EXPECT_GE(pid, 0);
  if (pid == 0) {
    std::vector<char*> argv = {const_cast<char*>(kProgram)};
    for (const std::string& argument : arguments) {
      argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    execv(kProgram, argv.data());
    _exit(127);
  }
  std::string shown;
  std::array<char, 4096> buffer;
  for (ssize_t size = 0; (size = read(terminal, buffer.data(), buffer.size())) > 0;) {
    shown.append(buffer.data(), static_cast<std::size_t>(size));
  }
  close(terminal);
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_EQ(status, 0) << shown;
  return shown;
}

TEST_F(OdometryApp, ShowsProgressOnATerminal) {
  const std::vector<std::string> arguments = Kitti({"--frames=0:3"});
  const auto shows = [](const std::string& bar) {
    return testing::ContainsRegex("\r\\[" + bar + ", [0-9.]+/s, [0-9]+ s left");
  };
  EXPECT_THAT(RunOnTerminal(arguments), AllOf(shows("#####---------------\\] 1/4 scans"),
                                              shows("####################\\] 4/4 scans")));
  // The rate of a run that goes on is not that of its replay.
  std::string journal = ReadFile(Path("out/journal.txt"));
  journal.resize(journal.rfind('\n', journal.size() - 2) + 1);
  folder_.Write("out/journal.txt", journal);
  EXPECT_THAT(RunOnTerminal(arguments), AllOf(shows("####################\\] 3/3 scans replayed"),
                                              shows("####################\\] 1/1 scans")));
}

TEST(OdometryCommandLine, HelpsWithItsOwnFlags) {
  const Outcome outcome = RunProgram("odometry", {"--help"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("--map_every"), HasSubstr("--restart"), HasSubstr("--octree_voxel_m"),
                    HasSubstr("--metrics"), HasSubstr("--scene"), Not(HasSubstr("--frame ")),
                    Not(HasSubstr("--source")), Not(HasSubstr("logtostderr"))));
}

}  // namespace
}  // namespace icpscape
