// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "icpscape/common/error.h"
#include "tests/support/message_of.h"
#include "tests/support/real_scans.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::ReadFile;
using testing_support::TemporaryFolder;

std::string RefusalOf(const std::filesystem::path& path) {
  try {
    ReadTrajectory(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

// Numbers without a short decimal form, far from the origin.
Trajectory Winding() {
  Trajectory trajectory;
  SE3d T(Mat3::Identity(), Vec3(1e4 / 3, -2e3 / 7, 1.0 / 9));
  for (int i = 0; i < 50; ++i) {
    trajectory.T_world_body.push_back(T);
    trajectory.times_s.push_back(1.4e9 + i / 3.0);
    const Vec6 xi = (Vec6() << 0.02, -0.01, 0.3, 1.0 / 3, 0.1, -0.01).finished();
    T = (T * SE3d::Exp(xi)).Normalized();
  }
  return trajectory;
}

void ExpectReadsBack(const std::vector<SE3d>& written, const std::vector<SE3d>& read) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].t(), written[i].t());
    EXPECT_LE((read[i].R() - written[i].R()).norm(), 2e-15);
  }
}

TEST(Trajectory, ReadsKittiRows) {
  const TemporaryFolder folder;
  // Row 1 is turned by 90 degrees about z.
  const Trajectory trajectory = ReadTrajectory(
      folder.Write("t.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 4 1 0 0 5 0 0 1 6.5\n\n"));
  EXPECT_TRUE(trajectory.times_s.empty());
  ASSERT_EQ(trajectory.T_world_body.size(), 2U);
  EXPECT_EQ(trajectory.T_world_body[1].t(), Vec3(4, 5, 6.5));
  EXPECT_LE((trajectory.T_world_body[1] * Vec3(1, 0, 0) - Vec3(4, 6, 6.5)).norm(), 1e-15);
}

TEST(Trajectory, ReadsTumRowsAndSkipsComments) {
  const TemporaryFolder folder;
  // The same turn by 90 degrees, as a quaternion whose digits were cut.
  const Trajectory trajectory = ReadTrajectory(
      folder.Write("t.txt",
                   "# timestamp tx ty tz qx qy qz qw\n1305031102.175304 1 2 3 0 0 0 1\r\n\n"
                   "  # in between\n1305031102.211214 4 5 6.5 0 0 0.70711 0.70711\n"));
  EXPECT_EQ(trajectory.times_s, (std::vector<double>{1305031102.175304, 1305031102.211214}));
  ASSERT_EQ(trajectory.T_world_body.size(), 2U);
  EXPECT_EQ(trajectory.T_world_body[0].t(), Vec3(1, 2, 3));
  EXPECT_LE((trajectory.T_world_body[1] * Vec3(1, 0, 0) - Vec3(4, 6, 6.5)).norm(), 1e-15);
}

TEST(Trajectory, WhatIsWrittenReadsBack) {
  const TemporaryFolder folder;
  const Trajectory trajectory = Winding();
  WriteKittiTrajectory(folder.path() / "kitti.txt", trajectory.T_world_body);
  WriteTumTrajectory(folder.path() / "tum.txt", trajectory);
  const Trajectory kitti = ReadTrajectory(folder.path() / "kitti.txt");
  const Trajectory tum = ReadTrajectory(folder.path() / "tum.txt");
  ExpectReadsBack(trajectory.T_world_body, kitti.T_world_body);
  ExpectReadsBack(trajectory.T_world_body, tum.T_world_body);
  EXPECT_TRUE(kitti.times_s.empty());
  EXPECT_EQ(tum.times_s, trajectory.times_s);
}

// A parser of its own: the text alone, number by number.
TEST(Trajectory, TextIsWhatTheFormatsSay) {
  const TemporaryFolder folder;
  const Trajectory trajectory = Winding();
  WriteKittiTrajectory(folder.path() / "kitti.txt", trajectory.T_world_body);
  WriteTumTrajectory(folder.path() / "tum.txt", trajectory);
  std::istringstream kitti(ReadFile(folder.path() / "kitti.txt"));
  std::istringstream tum(ReadFile(folder.path() / "tum.txt"));
  std::string comment;
  std::getline(tum, comment);
  EXPECT_EQ(comment[0], '#');
  for (std::size_t i = 0; i < trajectory.times_s.size(); ++i) {
    const SE3d& T = trajectory.T_world_body[i];
    for (int row = 0; row < 3; ++row) {
      for (int col = 0; col < 4; ++col) {
        double value = 0;
        kitti >> value;
        EXPECT_EQ(value, T.Matrix()(row, col));
      }
    }
    double time = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
    tum >> time >> x >> y >> z >> qx >> qy >> qz >> qw;
    EXPECT_EQ(time, trajectory.times_s[i]);
    EXPECT_EQ(Vec3(x, y, z), T.t());
    // 2 acos(qw) is the angle of R, and (qx, qy, qz) its axis.
    EXPECT_NEAR(2 * qw * qw - 1, (T.R().trace() - 1) / 2, 1e-14);
    EXPECT_LE((T.R() * Vec3(qx, qy, qz) - Vec3(qx, qy, qz)).norm(), 1e-14);
  }
  std::string rest;
  EXPECT_FALSE(kitti >> rest);
  EXPECT_FALSE(tum >> rest);
}

TEST(Trajectory, WritesNoTumWithoutTimes) {
  Trajectory trajectory = Winding();
  trajectory.times_s.pop_back();
  const TemporaryFolder folder;
  const auto path = folder.path() / "tum.txt";
  EXPECT_THAT(testing_support::MessageOf<UsageError>([&] { WriteTumTrajectory(path, trajectory); }),
              HasSubstr("expected one for each, as the format of TUM asks"));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Trajectory, RefusesBrokenFilesInOneSentence) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    return RefusalOf(folder.Write("t.txt", text));
  };
  const std::string kitti = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  const std::string tum = "# comment\n1 0 0 0 0 0 0 1\n";
  EXPECT_THAT(RefusalOf(folder.path() / "none.txt"), HasSubstr("none.txt: cannot be read"));
  EXPECT_THAT(RefusalOf(folder.path()), HasSubstr("cannot be read"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("t.txt: the first row has 0 columns"));
  EXPECT_THAT(refusal("1 2 3\n"), HasSubstr("first row has 3 columns; expected 12"));
  EXPECT_THAT(refusal(kitti + "1 0 0\n"), HasSubstr("t.txt:2: 3 numbers"));
  EXPECT_THAT(refusal(tum + "2 0 0\n"), HasSubstr("t.txt:3: 3 columns; expected 8"));
  EXPECT_THAT(refusal(tum + "2 0 x 0 0 0 0 1\n"), HasSubstr("t.txt:3: \"x\""));
  EXPECT_THAT(refusal(tum + "2 0 nan 0 0 0 0 1\n"), HasSubstr("t.txt:3: \"nan\""));
  EXPECT_THAT(refusal(tum + "2 0 0 0 0 0 0 1.1\n"), HasSubstr("t.txt:3: the quaternion"));
  EXPECT_THAT(refusal(tum + "2 0 1e200 0 0 0 0 1\n"),
              HasSubstr("t.txt:3: a coordinate of 1e+200 m"));
  EXPECT_THAT(refusal(kitti + "1 0 0 0 0 1 0 2e9 0 0 1 0\n"),
              HasSubstr("t.txt:2: a coordinate of 2e+09"));
  EXPECT_THAT(RefusalOf("/dev/zero"), HasSubstr("/dev/zero: cannot be read"));
  EXPECT_THAT(refusal(tum + "1 0 0 0 0 0 0 1\n"), HasSubstr("t.txt:3: timestamp 1 is not after"));
}

// Text rounds quaternions: by a thousandth they may be off, and are normalised. On Earth no
// coordinate is beyond 1e9 m.
TEST(Trajectory, TakesWhatIsNearlyRight) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& row) {
    return RefusalOf(folder.Write("t.txt", "0 0 0 0 0 0 0 1\n" + row + "\n"));
  };
  EXPECT_EQ(read("1 0 0 0 0 0 0 1.0009"), "nothing was thrown");
  EXPECT_THAT(read("1 0 0 0 0 0 0 1.0011"), HasSubstr("the quaternion has norm 1.0011"));
  EXPECT_THAT(read("1 0 0 0 0 0 0 0.9989"), HasSubstr("the quaternion has norm 0.9989"));
  EXPECT_EQ(read("1 -1e9 0 0 0 0 0 1"), "nothing was thrown");
  EXPECT_THAT(read("1 0 0 -1.01e9 0 0 0 1"), HasSubstr("a coordinate of 1.01e+09 m"));
  EXPECT_THAT(read("-1 0 0 0 0 0 0 1"), HasSubstr("is not after the one before"));
}

TEST(Trajectory, ReadsTheOfficialPoses) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const Trajectory trajectory = ReadTrajectory(KittiFiles(KittiRoot(), "00").Poses());
  EXPECT_EQ(trajectory.T_world_body.size(), 4541U);
}

}  // namespace
}  // namespace icpscape
