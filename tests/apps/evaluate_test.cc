// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "icpscape/io/kitti_writer.h"
#include "icpscape/io/trajectory.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;
using testing_support::TemporaryFolder;

// Right round a circle of 200 m in steps of 1 m and more; the estimate's steps are 1 % too long.
class Evaluate : public testing::Test {
 protected:
  Evaluate() {
    std::filesystem::create_directories(folder_.path() / "kitti/poses");
    WriteKittiTrajectory(Path("kitti/poses/01.txt"), Circle(1, 300).T_world_body);
    WriteKittiTrajectory(Path("kitti/poses/02.txt"), Circle(2, 300).T_world_body);
    WriteKittiTrajectory(Path("1.txt"), Circle(1.01, 300).T_world_body);
    WriteKittiTrajectory(Path("2.txt"), Circle(2.02, 300).T_world_body);
  }

  static Trajectory Circle(double step_m, int count) {
    Trajectory trajectory;
    for (int i = 0; i < count; ++i) {
      const double angle = i * 0.01;
      const double radius = step_m / 0.01;
      trajectory.T_world_body.emplace_back(
          Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(),
          radius * Vec3(std::sin(angle), 1 - std::cos(angle), 0));
      trajectory.times_s.push_back(i * 0.1);
    }
    return trajectory;
  }

  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::vector<std::string> Kitti(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"--kitti_root=" + Path("kitti"), "--sequences=01,02",
                                          "--estimate=" + Path("1.txt") + "," + Path("2.txt"),
                                          "--out=" + Path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  // A cell of the first row where `column` is `value`.
  std::string Cell(const std::string& table, const std::string& value, const std::string& cell,
                   const std::string& column = "sequence") const {
    for (const auto& row : ReadCsv(Path("out/" + table))) {
      if (row.at(column) == value) {
        return row.at(cell);
      }
    }
    return "no such row";
  }

  TemporaryFolder folder_;
};

TEST_F(Evaluate, WritesTablesFiguresAndManifest) {
  const Outcome outcome = RunProgram("evaluate", Kitti());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  // Chords are 1 % longer; the circle's chord of 101 m, for the nominal 100 m, is 2 r sin(101 / 2
  // r).
  const double chord = 2 * 100 * std::sin(0.01 * 101 / 2);
  EXPECT_NEAR(std::stod(ReadCsv(Path("out/errors.csv"))[0].at("t_err_percent")), 0.01 * chord,
              1e-3);
  const double mean_1 = std::stod(Cell("summary.csv", "01", "t_err_percent"));
  const double mean_2 = std::stod(Cell("summary.csv", "02", "t_err_percent"));
  const double segments_1 = std::stod(Cell("summary.csv", "01", "segments"));
  const double segments_2 = std::stod(Cell("summary.csv", "02", "segments"));
  EXPECT_NEAR(std::stod(Cell("summary.csv", "mean_of_sequences", "t_err_percent")),
              (mean_1 + mean_2) / 2, 1e-12);
  EXPECT_NEAR(std::stod(Cell("summary.csv", "all_segments", "t_err_percent")),
              (segments_1 * mean_1 + segments_2 * mean_2) / (segments_1 + segments_2), 1e-12);
  EXPECT_EQ(segments_1 + segments_2, static_cast<double>(ReadCsv(Path("out/errors.csv")).size()));
  EXPECT_LT(std::stod(Cell("pose_errors.csv", "rigid", "rmse_m", "alignment")),
            std::stod(Cell("pose_errors.csv", "none", "rmse_m", "alignment")));
  EXPECT_NEAR(std::stod(Cell("pose_errors.csv", "RPE_1", "max_m", "error")), 0.01, 1e-6);
  const auto trajectory = ReadCsv(Path("out/trajectory.csv"));
  ASSERT_EQ(trajectory.size(), 600U);
  EXPECT_EQ(trajectory[0].at("error_m"), "0");
  EXPECT_NEAR(std::stod(trajectory[299].at("path_m")), 299, 0.01);
  EXPECT_THAT(ReadFile(Path("out/trajectory.svg")), HasSubstr("</svg>"));
  const auto manifest = nlohmann::json::parse(ReadFile(Path("out/manifest.json")));
  EXPECT_EQ(manifest["inputs"].size(), 4U);
  EXPECT_TRUE(manifest["results"].contains("t_err_percent"));
}

TEST_F(Evaluate, TumByTimeAgreesWithKittiByRow) {
  Trajectory estimate = Circle(1.01, 300);
  estimate.times_s.back() = 100;  // Without a true pose at that time.
  WriteTumTrajectory(Path("estimate.tum"), estimate);
  WriteTumTrajectory(Path("truth.tum"), Circle(1, 300));
  const Outcome outcome =
      RunProgram("evaluate", {"--estimate=" + Path("estimate.tum"),
                              "--ground_truth=" + Path("truth.tum"), "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("299 pairs of poses (300 estimated, 300 true)"));
  const std::string tum = ReadCsv(Path("out/errors.csv"))[0].at("t_err_percent");
  ASSERT_EQ(RunProgram("evaluate", Kitti()).code, 0);
  EXPECT_NEAR(std::stod(tum), std::stod(ReadCsv(Path("out/errors.csv"))[0].at("t_err_percent")),
              1e-9);
}

// Part of a drive against the same part of the truth: frames 100 to 299 of a circle, whose estimate
// is again 1 % too long. Twice as slow by its times.txt.
TEST_F(Evaluate, TakesPartOfTheTruthAndItsTimes) {
  Trajectory part = Circle(1.01, 300);
  part.T_world_body.erase(part.T_world_body.begin(), part.T_world_body.begin() + 100);
  WriteKittiTrajectory(Path("part.txt"), part.T_world_body);
  const std::vector<std::string> flags = {"--kitti_root=" + Path("kitti"), "--sequences=01",
                                          "--estimate=" + Path("part.txt"), "--out=" + Path("out")};
  ExpectRefusal(RunProgram("evaluate", flags), 2,
                "200 estimated poses for a ground truth of 300; expected as many");
  std::vector<std::string> with_frames = flags;
  with_frames.push_back("--frames=100:299");
  ASSERT_EQ(RunProgram("evaluate", with_frames).code, 0);
  EXPECT_NEAR(std::stod(Cell("summary.csv", "01", "t_err_percent")), 1, 0.1);
  const double devkit_mps = std::stod(ReadCsv(Path("out/errors.csv")).front().at("speed_mps"));
  std::string times;
  for (int i = 0; i < 300; ++i) {
    times += std::to_string(0.2 * i) + "\n";
  }
  folder_.Write("kitti/sequences/01/times.txt", times);
  ASSERT_EQ(RunProgram("evaluate", with_frames).code, 0);
  // The devkit counts one period more than there is.
  const double mps = std::stod(ReadCsv(Path("out/errors.csv")).front().at("speed_mps"));
  EXPECT_NEAR(mps, devkit_mps / 2, 0.02 * mps);
  folder_.Write("kitti/sequences/01/times.txt", "0\n\n" + times.substr(times.find('\n') + 1));
  ExpectRefusal(RunProgram("evaluate", with_frames), 2, "301 times; expected one for each of 300");
  times.replace(times.find("0.2"), times.find("\n0.4") - times.find("0.2"), "");
  folder_.Write("kitti/sequences/01/times.txt", times);
  ExpectRefusal(RunProgram("evaluate", with_frames), 2, "times.txt:2: a blank line");
  std::filesystem::remove(Path("kitti/sequences/01/times.txt"));
  with_frames.back() = "--frames=100:300";
  ExpectRefusal(RunProgram("evaluate", with_frames), 2, "expected --frames within 0:299");
}

TEST_F(Evaluate, CalibrationTurnsLidarPosesIntoTheCameras) {
  const SE3d Tr((Mat3() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished(), Vec3(0.1, -0.2, -0.3));
  WriteKittiPoses(Path("camera.txt"), Circle(1, 300).T_world_body, Tr);
  WriteKittiCalibration(Path("calib.txt"), Tr);
  const std::vector<std::string> arguments = {"--estimate=" + Path("kitti/poses/01.txt"),
                                              "--ground_truth=" + Path("camera.txt"),
                                              "--out=" + Path("out")};
  const auto largest_error = [&](std::vector<std::string> more) {
    more.insert(more.end(), arguments.begin(), arguments.end());
    EXPECT_EQ(RunProgram("evaluate", more).code, 0);
    return std::stod(Cell("pose_errors.csv", "none", "max_m", "alignment"));
  };
  EXPECT_LT(largest_error({"--calib=" + Path("calib.txt")}), 1e-9);
  EXPECT_GT(largest_error({}), 1);
}

TEST_F(Evaluate, ShortAndStraightTrajectoriesStillHaveTheRest) {
  std::string rows;
  for (int i = 0; i < 5; ++i) {
    rows += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
  }
  folder_.Write("short.txt", rows);
  const Outcome outcome =
      RunProgram("evaluate", {"--estimate=" + Path("short.txt"),
                              "--ground_truth=" + Path("short.txt"), "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("short: a path of 4.0 m; t_err and r_err need more than 100"));
  EXPECT_THAT(outcome.out, HasSubstr("short: its positions lie on one line"));
  EXPECT_EQ(ReadCsv(Path("out/errors.csv")).size(), 0U);
  EXPECT_EQ(ReadCsv(Path("out/pose_errors.csv")).size(), 3U);
}

TEST_F(Evaluate, RefusesInOneSentence) {
  const auto run = [&](const std::string& estimate, const std::string& truth,
                       const std::string& more) {
    return RunProgram("evaluate", {"--estimate=" + Path(estimate), "--ground_truth=" + Path(truth),
                                   "--out=" + Path("refused"), more});
  };
  ExpectRefusal(RunProgram("evaluate", {}), 1, "no --estimate");
  ExpectRefusal(RunProgram("evaluate", {"--estimate=x"}), 1, "expected --ground_truth=FILE, or");
  ExpectRefusal(RunProgram("evaluate", Kitti({"--ground_truth=x"})), 1, "not both");
  ExpectRefusal(RunProgram("evaluate", Kitti({"--sequences=01"})), 1, "one for each --estimate");
  ExpectRefusal(RunProgram("evaluate", Kitti({"--calib=a,b,c"})), 1, "one, or one for each");
  ExpectRefusal(RunProgram("evaluate", Kitti({"--estimate=a,,b"})), 1, "single commas");
  ExpectRefusal(run("1.txt", "2.txt", "--sequences=01"), 1, "--kitti_root with it");
  ExpectRefusal(run("1.txt", "2.txt", "--rpe_frames=0"), 1, "at least 1");
  ExpectRefusal(run("1.txt", "2.txt", "--rpe_frames=300"), 1, "fewer than the 300 poses of 1");
  ExpectRefusal(run("1.txt", "2.txt", "--max_time_difference_s=nan"), 1, "at least 0 s");
  ExpectRefusal(run("none.txt", "2.txt", "--rpe_frames=1"), 2, "none.txt: cannot be read");
  folder_.Write("torn.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1\n");
  ExpectRefusal(run("torn.txt", "2.txt", "--rpe_frames=1"), 2, "torn.txt:2: 6 numbers");
  folder_.Write("one.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  ExpectRefusal(run("one.txt", "2.txt", "--rpe_frames=1"), 2,
                "1 estimated poses for a ground truth of 300");
  ExpectRefusal(run("one.txt", "one.txt", "--rpe_frames=1"), 2,
                "pairs of poses in the files: 1; expected at least two");
  EXPECT_FALSE(std::filesystem::exists(Path("refused/summary.csv")));
}

}  // namespace
}  // namespace icpscape
