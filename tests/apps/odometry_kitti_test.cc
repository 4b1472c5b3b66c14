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
