// SPDX-License-Identifier: BSD-3-Clause
// When scans and their points were measured.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "icpscape/io/trajectory.h"
#include "tests/apps/odometry_fixture.h"

namespace icpscape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing_support::Bytes;
using testing_support::DistanceM;
using testing_support::ExpectRefusal;
using testing_support::kScans;
using testing_support::OdometryApp;
using testing_support::Outcome;
using testing_support::ReadFile;
using testing_support::RunProgram;
using testing_support::ScanName;
using testing_support::TheDrive;

// Scans 4 to 7 are missing, as in KITTI's raw drive 2011_09_26 0009.
TEST_F(OdometryApp, SaysWhereTimesWereTakenFrom) {
  std::string lines, stamps;
  for (int i = 0; i < kScans; ++i) {
    const std::string second = std::to_string(30 + i / 10) + "." + std::to_string(i % 10);
    if (i >= 4 && i < 8) {
      lines += "\n";
      continue;
    }
    lines += "2011-09-26 13:02:" + second + "00000000\n";
    stamps += second + " 0 0 0 0 0 0 1\n";
    folder_.Write("raw/velodyne_points/data/0000" + ScanName(i),
                  Bytes(TheDrive().scans[static_cast<std::size_t>(i)]));
  }
  folder_.Write("raw/velodyne_points/timestamps.txt", lines);
  folder_.Write("tum.txt", stamps);
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"--scans=" + Path("raw"), "--out=" + Path("out")});
    return RunProgram("odometry", more);
  };
  Outcome outcome = run({});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("times: timestamps.txt, 1 gap of 0.5 s\n"),
                                 HasSubstr("path: 8.8 m")));
  EXPECT_EQ(nlohmann::json::parse(ReadFile(Path("out/manifest.json")))["results"]["times"],
            "timestamps.txt, 1 gap of 0.5 s");
  const SE3d end = ReadTrajectory(Path("out/trajectory_tum.txt")).T_world_body.back();
  EXPECT_LT(DistanceM(end, TheDrive().T_world_lidar.back()), 0.05);
  // Results depend on the times: with others the journal is another's.
  ExpectRefusal(run({"--timestamps=" + Path("tum.txt")}), 2, "times=");
  outcome = run({"--timestamps=" + Path("tum.txt"), "--restart"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("times: tum.txt, 1 gap of 0.5 s\n"));
  EXPECT_EQ(ReadTrajectory(Path("out/trajectory_tum.txt")).times_s[4], 30.8);
  folder_.Write("tum.txt", stamps + "99\n");
  ExpectRefusal(run({"--timestamps=" + Path("tum.txt")}), 2,
                "tum.txt: 9 times; expected one for each of the 8 scans.");
  // Without a file the numbers of a raw drive's scans tell as much.
  std::filesystem::remove(Path("raw/velodyne_points/timestamps.txt"));
  outcome = run({"--restart"});
  EXPECT_THAT(outcome.out,
              HasSubstr("times: numbers of the scans, taken as 10 Hz, 1 gap of 0.5 s\n"));
}

TEST_F(OdometryApp, DeskewsScansWithTimes) {
  const std::string root = Path("skewed");
  const Outcome simulated = RunProgram(
      "simulate", {"--scene=right_turn", "--skewed", "--azimuth_step_deg=1", "--out=" + root});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"--kitti_root=" + root, "--sequence=right_turn", "--out=" + Path("out")});
    return RunProgram("odometry", more);
  };
  Outcome outcome = run({});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("de-skewed: 3 of 3 scans\n"));
  const auto end_off = [&] {
    return nlohmann::json::parse(ReadFile(Path("out/manifest.json")))["results"]["end_off_m"]
        .get<double>();
  };
  const double deskewed = end_off();
  EXPECT_LT(deskewed, 0.03);
  // The times of the points are input as the points are.
  const std::string times = root + "/sequences/right_turn/times/000001.time";
  const std::string bytes = ReadFile(times);
  std::ofstream(times, std::ios::binary) << std::string(bytes.size(), '\0');
  ExpectRefusal(run({}), 2, "000001.bin: is not the scan of the journal");
  std::filesystem::remove(times);
  ExpectRefusal(run({"--deskew=on", "--restart"}), 2,
                "000001.bin: the points have no times; expected them");
  std::ofstream(times, std::ios::binary) << bytes;
  outcome = run({"--deskew=off", "--restart"});
  EXPECT_THAT(outcome.out, Not(HasSubstr("de-skewed")));
  EXPECT_GT(end_off(), 1.3 * deskewed);
}

}  // namespace
}  // namespace icpscape
