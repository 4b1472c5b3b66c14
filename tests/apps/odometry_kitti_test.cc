// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "icpscape/io/sequences.h"
#include "icpscape/io/trajectory.h"
#include "tests/apps/odometry_fixture.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

using testing_support::DistanceM;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;
using testing_support::TemporaryFolder;
using testing_support::WithoutFigures;

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
  const SE3d truth = *OpenKittiSequence(KittiRoot(), "07").Motion(0, 4);
  EXPECT_LT(DistanceM(Poses().back(), truth), 0.02);
}

// The truth of these frames is poor: the drive there and back must end at its start.
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

// 2.7 m a scan along the motorway of sequence 01, as a raw drive without scans 8 to 11.
TEST_F(OdometryOnKitti, BridgesAGap) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::string simulated = (folder_.path() / "simulated").string();
  ASSERT_EQ(RunProgram("simulate", {"--kitti_root=" + KittiRoot().string(), "--sequence=01",
                                    "--frames=300:319", "--out=" + simulated})
                .code,
            0);
  std::string times;
  for (int i = 0; i < 20; ++i) {
    if (i >= 8 && i < 12) {
      times += "\n";
      continue;
    }
    times += std::to_string(0.1 * i) + "\n";
    const std::string name = (i < 10 ? "00000" : "0000") + std::to_string(i) + ".bin";
    folder_.Write("drive/velodyne_points/data/0000" + name,
                  ReadFile(simulated + "/sequences/01/velodyne/" + name));
  }
  folder_.Write("drive/velodyne_points/timestamps.txt", times);
  const Outcome outcome = Run({"--scans=" + (folder_.path() / "drive").string()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("times: timestamps.txt, 1 gap of 0.5 s\npath: 50.7 m"),
            std::string::npos)
      << outcome.out;
  const SE3d truth = *OpenKittiSequence(simulated, "01").Motion(0, 19);
  EXPECT_LT(DistanceM(Poses().back(), truth), 0.1);
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
