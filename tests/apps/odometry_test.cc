// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/file.h>

#include <array>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <thread>

#include "src/io/point_files.h"
#include "src/io/trajectory.h"
#include "src/io/transform.h"
#include "src/odometry/frame_record.h"
#include "tests/support/drives.h"
#include "tests/support/real_scans.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;
using testing_support::SimulatedDrive;
using testing_support::TemporaryFolder;

constexpr char kProgram[] = ICPSCAPE_BIN_DIR "/icpscape-odometry";
constexpr int kScans = 12;
// What must not depend on how often the run was interrupted.
constexpr const char* kResults[] = {"trajectory_kitti.txt", "trajectory_tum.txt", "frames.csv",
                                    "map.ply", "trajectory.csv"};

const SimulatedDrive& TheDrive() {
  static const SimulatedDrive drive = testing_support::SimulateTownDrive(kScans);
  return drive;
}

std::string Bytes(const PointCloud& cloud) {
  std::string bytes;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float record[] = {cloud.x[i], cloud.y[i], cloud.z[i], cloud.intensity[i]};
    bytes.append(reinterpret_cast<const char*>(record), sizeof record);
  }
  return bytes;
}

std::string ScanName(int i) { return (i < 10 ? "00000" : "0000") + std::to_string(i) + ".bin"; }

double DistanceM(const SE3d& a, const SE3d& b) { return (a.Inverse() * b).t().norm(); }

/// While it lives, Python finds no matplotlib: no time goes into figures.
class WithoutFigures {
 public:
  WithoutFigures() {
    folder_.Write("matplotlib.py", "raise ImportError\n");
    setenv("PYTHONPATH", folder_.path().c_str(), 1);
  }
  ~WithoutFigures() { unsetenv("PYTHONPATH"); }

 private:
  TemporaryFolder folder_;
};

/// A simulated drive as a KITTI sequence, whose camera looks forward.
class OdometryApp : public testing::Test {
 protected:
  OdometryApp() {
    std::string times, poses;
    for (int i = 0; i < kScans; ++i) {
      const auto k = static_cast<std::size_t>(i);
      folder_.Write(Scan(i), Bytes(TheDrive().scans[k]));
      times += std::to_string(times_s_[k]) + "\n";
      poses += FormatTransformRow(Tr_ * TheDrive().T_world_lidar[k] * Tr_.Inverse()) + "\n";
    }
    folder_.Write("kitti/sequences/05/times.txt", times);
    folder_.Write("kitti/sequences/05/calib.txt", "Tr: " + FormatTransformRow(Tr_) + "\n");
    folder_.Write("kitti/poses/05.txt", poses);
  }

  static std::string Scan(int i) { return "kitti/sequences/05/velodyne/" + ScanName(i); }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::vector<std::string> Kitti(std::vector<std::string> more = {},
                                 const std::string& out = "out") const {
    more.insert(more.begin(), {"--kitti_root=" + Path("kitti"), "--sequence=05",
                               "--out=" + Path(out), "--threads=2"});
    return more;
  }
  Outcome Run(std::vector<std::string> more = {}, const std::string& out = "out") const {
    return RunProgram("odometry", Kitti(std::move(more), out));
  }

  // The lines of the journal after its header.
  std::vector<FrameRecord> Journal(const std::string& out = "out") const {
    std::vector<FrameRecord> records;
    std::istringstream in(ReadFile(Path(out + "/journal.txt")));
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      records.push_back(ParseFrameRecord(line.substr(0, line.rfind(' ')), "journal"));
    }
    return records;
  }

  void ExpectSameResults(const std::string& a, const std::string& b) const {
    for (const std::string name : kResults) {
      const std::string text = ReadFile(Path(a + "/" + name));
      EXPECT_FALSE(text.empty()) << name;
      EXPECT_TRUE(text == ReadFile(Path(b + "/" + name))) << name;
    }
  }

  TemporaryFolder folder_;
  std::optional<WithoutFigures> without_figures_{std::in_place};
  const SE3d Tr_{(Mat3() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished(), Vec3(0.125, 0.25, 0.5)};
  const std::array<double, kScans> times_s_ = {0,    0.1,  0.21, 0.3,  0.42, 0.5,
                                               0.61, 0.72, 0.8,  0.93, 1,    1.125};
};

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

// Starts the program with its output thrown away.
pid_t Spawn(const std::vector<std::string>& arguments) {
  std::vector<char*> argv = {const_cast<char*>(kProgram)};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t pid = -1;
  EXPECT_EQ(posix_spawn(&pid, kProgram, &actions, nullptr, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

// One run that is killed ten times, a few milliseconds after one more scan was reported.
TEST_F(OdometryApp, LosesNothingWhenItIsKilled) {
  ASSERT_EQ(Run({"--threads=1"}, "whole").code, 0);
  const auto lines = [&] {
    const std::string text = ReadFile(Path("out/journal.txt"));
    return std::count(text.begin(), text.end(), '\n');
  };
  std::mt19937 engine(1);
  int killed = 0;
  for (int kill_number = 1; kill_number <= 10; ++kill_number) {
    const pid_t pid = Spawn(Kitti());
    int status = 0;
    pid_t ended = 0;
    while (lines() < 1 + kill_number && ended == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ended = waitpid(pid, &status, WNOHANG);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(engine() % 20000));
    if (ended == 0) {
      kill(pid, SIGKILL);
      waitpid(pid, &status, 0);
    }
    killed += WIFSIGNALED(status) ? 1 : 0;
    const auto reported = lines();
    if (kill_number % 3 == 0) {  // A write that the system had not finished.
      std::ofstream(Path("out/journal.txt"), std::ios::app) << "0123 1 0 17 0.02";
    }
    EXPECT_GE(reported, 1 + kill_number);
  }
  EXPECT_GE(killed, 5);
  const Outcome outcome = Run();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("scans are done, and are replayed"));
  ExpectSameResults("out", "whole");
}

// A run that is done is told again from its journal alone.
TEST_F(OdometryApp, RepeatsItsResults) {
  for (const char* mode : {"scan_to_scan", "two_stage"}) {
    const std::vector<std::string> flags = {std::string("--mode=") + mode, "--frames=0:5",
                                            "--map_every=2", "--restart"};
    ASSERT_EQ(Run(flags, "first").code, 0);
    std::filesystem::remove_all(Path("again"));
    std::filesystem::create_directories(Path("again"));
    // All but two of the scans.
    const std::string journal = ReadFile(Path("first/journal.txt"));
    std::size_t end = journal.size() - 1;
    for (int line = 0; line < 2; ++line) {
      end = journal.rfind('\n', end - 1);
    }
    folder_.Write("again/journal.txt", journal.substr(0, end + 1));
    ASSERT_EQ(Run({flags[0], flags[1], flags[2]}, "again").code, 0);
    ExpectSameResults("again", "first");
  }
}

TEST_F(OdometryApp, GoesOnWithTheSameFlagsAlone) {
  const std::string frames = "--frames=0:2";
  ASSERT_EQ(Run({frames, "--mode=scan_to_scan"}).code, 0);
  const std::string journal = ReadFile(Path("out/journal.txt"));
  ExpectRefusal(Run({frames, "--mode=two_stage"}), 2,
                "journal.txt: was written with mode=scan_to_scan, now mode=two_stage");
  ExpectRefusal(Run({"--frames=0:3", "--mode=scan_to_scan"}), 2, "frames=0:2, now frames=0:3");
  EXPECT_EQ(ReadFile(Path("out/journal.txt")), journal);
  ASSERT_EQ(Run({frames, "--mode=two_stage", "--restart"}).code, 0);
  EXPECT_NE(ReadFile(Path("out/journal.txt")), journal);
  EXPECT_EQ(Run({frames, "--mode=two_stage", "--threads=1"}).code, 0);

  folder_.Write(Scan(1), Bytes(TheDrive().scans[2]));
  ExpectRefusal(Run({frames, "--mode=two_stage"}), 2,
                "000001.bin: is not the scan of the journal; expected it unchanged, or --restart.");
  EXPECT_FALSE(std::filesystem::exists(Path("out/manifest.json")));  // The mark of a finished run.
  EXPECT_EQ(Run({frames, "--mode=two_stage", "--restart"}).code, 0);

  // The data may have moved since.
  std::filesystem::rename(Path("kitti"), Path("moved"));
  EXPECT_EQ(RunProgram("odometry", {"--kitti_root=" + Path("moved"), "--sequence=05", frames,
                                    "--mode=two_stage", "--out=" + Path("out")})
                .code,
            0);
  std::filesystem::rename(Path("moved"), Path("kitti"));

  // Not even --restart takes the folder from a run that is at it.
  const int file = open(Path("out/journal.txt").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(file, LOCK_EX), 0);
  const std::string kept = ReadFile(Path("out/journal.txt"));
  ExpectRefusal(Run({frames, "--restart"}), 2, "journal.txt: another run writes it");
  EXPECT_EQ(ReadFile(Path("out/journal.txt")), kept);
  close(file);
}

TEST_F(OdometryApp, KeepsWhatWasDoneBeforeABadScan) {
  const std::vector<std::string> frames = {"--frames=0:5"};
  ASSERT_EQ(Run(frames, "whole").code, 0);
  const std::string scan = ReadFile(Path(Scan(3)));
  folder_.Write(Scan(3), scan.substr(0, 1000));
  ExpectRefusal(Run(frames), 2, "000003.bin: 1000 bytes; expected a multiple of 16");
  EXPECT_EQ(Journal().size(), 3U);
  EXPECT_FALSE(std::filesystem::exists(Path("out/trajectory_kitti.txt")));
  EXPECT_FALSE(std::filesystem::exists(Path("out/manifest.json")));
  folder_.Write(Scan(3), scan);
  const Outcome outcome = Run(frames);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("journal: 3 scans are done, and are replayed"));
  ExpectSameResults("out", "whole");
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
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("frame 2: the points form"));
  EXPECT_THAT(outcome.out, HasSubstr("could not be registered: the prediction stands in"));
}

TEST_F(OdometryApp, RefusesMissingData) {
  ExpectRefusal(Run({"--sequence=77"}), 2, "sequences/77: no such folder");
  ExpectRefusal(Run({"--frames=10:12"}), 2, "000012.bin: no such scan");
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
  refuse({"--write_map_voxel_m=-1"}, "--write_map_voxel_m=-1");
  refuse({"--prediction=crystal_ball"}, "expected one of constant_velocity, none");
  refuse({"--frames=5:1"}, "--frames=5:1: expected FIRST:LAST with 0 <= FIRST <= LAST");
  refuse({"--scans=no_scans"}, "--scans=DIR, and not both");
  refuse({"--ground_truth=a.txt"}, "--ground_truth=a.txt: expected --scans with it");
  refuse({"--metrics=edge_to_line", "--voxel_m=0.25"},
         "--voxel_m=0.25: expected 0 with edge_to_line");
  refuse({"--metrics=edge_to_line", "--octree_voxel_m=0.1"},
         "maps of edges and planar points are none");
  refuse({"--metrics=point_to_pint"}, "expected one of point_to_point");
  refuse({"--weights=1,2"}, "--weights=1,2: expected one weight per metric");
  refuse({"--reassociation=every_evaluation", "--adaptive_gate_m=2"},
         "adaptive gate rejects pairs");
  refuse({"--max_iterations=0"}, "--max_iterations");
  refuse({"stray"}, "stray argument \"stray\"");
  ExpectRefusal(RunProgram("odometry", {}), 1,
                "expected --kitti_root=DIR --sequence=SS, or --scans");
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
  EXPECT_THAT(outcome.out, HasSubstr("drive reversed: 3 scans, 11.ply to 9.ply, no times: 10 Hz"));
  const std::vector<SE3d> poses = ReadTrajectory(Path("out/trajectory_kitti.txt")).T_world_body;
  ASSERT_EQ(poses.size(), 3U);  // Without a camera the poses are the lidar's.
  const SE3d expected = TheDrive().T_world_lidar[3].Inverse() * TheDrive().T_world_lidar[1];
  EXPECT_LT(DistanceM(poses[2], expected), 0.03);
  EXPECT_LT(poses[2].t().x(), -1);  // Backwards.
  EXPECT_LT(nlohmann::json::parse(ReadFile(Path("out/manifest.json")))["results"]["end_off_m"],
            0.03);
}

TEST_F(OdometryApp, TakesFoldersOfAnyName) {
  std::filesystem::create_directories(Path("a drive;\nwith = \"signs\""));
  WritePly(Path("a drive;\nwith = \"signs\"/0.ply"), TheDrive().scans[0]);
  for (const char* journal : {"", "journal: 1 scans are done, and are replayed"}) {
    const Outcome outcome = RunProgram(
        "odometry", {"--scans=" + Path("a drive;\nwith = \"signs\""), "--out=" + Path("out")});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(journal));
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
                    HasSubstr("--metrics"), Not(HasSubstr("--scene")), Not(HasSubstr("--frame ")),
                    Not(HasSubstr("--source")), Not(HasSubstr("logtostderr"))));
}

// The program's defaults on real drives.
class OdometryOnKitti : public testing::Test {
 protected:
  std::string Out() const { return (folder_.path() / "out").string(); }
  Outcome Run(std::vector<std::string> flags) const {
    flags.insert(flags.end(), {"--out=" + Out(), "--threads=2", "--restart"});
    return RunProgram("odometry", flags);
  }
  std::vector<SE3d> Poses() const {
    return ReadTrajectory(Out() + "/trajectory_tum.txt").T_world_body;
  }
  void ExpectAllRegistered(std::size_t count) const {
    auto frames = ReadCsv(Out() + "/frames.csv");
    ASSERT_EQ(frames.size(), count);
    for (std::size_t i = 1; i < count; ++i) {
      EXPECT_EQ(frames[i]["registered"], "1") << i;
    }
  }

  TemporaryFolder folder_;
  WithoutFigures without_figures_;
};

TEST_F(OdometryOnKitti, EndsWithinTwoCentimetres) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  ASSERT_EQ(Run({"--kitti_root=" + KittiRoot().string(), "--sequence=07", "--frames=0:4"}).code, 0);
  ExpectAllRegistered(5);
  const auto manifest = nlohmann::json::parse(ReadFile(Out() + "/manifest.json"));
  EXPECT_LT(manifest["results"]["end_off_m"], 0.02);
  const SE3d truth = KittiSequence(KittiRoot(), "07").RelativeMotion(0, 4);
  EXPECT_LT(DistanceM(Poses().back(), truth), 0.02);
}

// The truth of these frames is poor: the drive is its own witness.
TEST_F(OdometryOnKitti, AgreesForwardsAndBackwards) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::vector<std::string> flags = {"--kitti_root=" + KittiRoot().string(), "--sequence=00",
                                          "--frames=0:15"};
  ASSERT_EQ(Run(flags).code, 0);
  ExpectAllRegistered(16);
  const SE3d forwards = Poses().back();
  ASSERT_EQ(Run({flags[0], flags[1], flags[2], "--reverse"}).code, 0);
  ExpectAllRegistered(16);
  const SE3d backwards = Poses().back();
  EXPECT_GT(forwards.t().norm(), 11);
  EXPECT_LT((forwards * backwards).t().norm(), 0.05);
}

TEST_F(OdometryOnKitti, RunsThroughARawDrive) {
  const std::filesystem::path drive = KittiRoot() / "raw/2011_09_26/drive_0048";
  if (!std::filesystem::is_directory(drive)) {
    GTEST_SKIP() << "no raw drive: " << drive;
  }
  ASSERT_EQ(Run({"--scans=" + drive.string()}).code, 0);
  ExpectAllRegistered(22);
  const std::vector<SE3d> poses = Poses();
  for (std::size_t i = 1; i < poses.size(); ++i) {  // About 0.8 m a frame, straight on.
    EXPECT_NEAR((poses[i - 1].Inverse() * poses[i]).t().x(), 0.8, 0.2) << i;
  }
}

}  // namespace
}  // namespace icpscape
