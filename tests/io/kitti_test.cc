// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/kitti.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "icpscape/common/error.h"
#include "icpscape/io/kitti_writer.h"
#include "icpscape/io/sequences.h"
#include "tests/support/message_of.h"
#include "tests/support/real_scans.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::MessageOf;
using testing_support::TemporaryFolder;

std::string Floats(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

TEST(Velodyne, ReadsAndCountsWhatItDrops) {
  const TemporaryFolder folder;
  const auto path = folder.Write("scan.bin", Floats({1, 2, 3, 0.5, 0, 0, 0, 0, NAN, 1, 1, 0.1F,  //
                                                     4, 5, 6, 0.25}));
  DroppedPoints dropped;
  const PointCloud cloud = ReadVelodyne(path, &dropped);
  EXPECT_EQ(dropped.zero, 1U);
  EXPECT_EQ(dropped.non_finite, 1U);
  EXPECT_EQ(cloud.x, (std::vector<float>{1, 4}));
  EXPECT_EQ(cloud.z, (std::vector<float>{3, 6}));
  EXPECT_EQ(cloud.intensity, (std::vector<float>{0.5, 0.25}));
}

TEST(Velodyne, RefusesBrokenFilesInOneSentence) {
  const TemporaryFolder folder;
  DroppedPoints dropped;
  const auto message = [&](const std::filesystem::path& path) {
    return MessageOf<InputError>([&] { ReadVelodyne(path, &dropped); });
  };
  EXPECT_THAT(message(folder.path() / "none.bin"), HasSubstr("none.bin: cannot be read"));
  EXPECT_THAT(message(folder.path()), HasSubstr("cannot be read"));
  EXPECT_THAT(message(folder.Write("torn.bin", Floats({1, 2, 3, 4, 5}))),
              HasSubstr("20 bytes; expected a multiple of 16"));
  EXPECT_THAT(message(folder.Write("empty.bin", "")), HasSubstr("no usable point among 0"));
  EXPECT_THAT(message(folder.Write("nan.bin", Floats({NAN, 0, 0, 0}))),
              HasSubstr("no usable point among 1"));
}

TEST(Velodyne, WritesLabelsAndRingsOfEveryPointOrNone) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "0";
  PointCloud cloud;
  cloud.x = cloud.y = cloud.z = {1, 2};
  cloud.label = cloud.ring = {3};
  EXPECT_EQ(MessageOf<UsageError>([&] { WriteLabels(path, cloud); }),
            path.string() + ": 1 labels for 2 points; expected one for each.");
  EXPECT_EQ(MessageOf<UsageError>([&] { WriteRings(path, cloud); }),
            path.string() + ": 1 rings for 2 points; expected one for each.");
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(KittiPoses, MotionGoesThroughTheCalibration) {
  const TemporaryFolder folder;
  // The camera looks along the lidar's x: p_camera = (-y, -z, x).
  folder.Write("sequences/09/calib.txt",
               "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  // The camera moves 2 m along its z (forwards) from row 0 to row 1.
  folder.Write("poses/09.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 2\n");
  const SE3d T = *OpenKittiSequence(folder.path(), "09").Motion(0, 1);
  EXPECT_LE((T.t() - Vec3(2, 0, 0)).norm(), 1e-12);
  EXPECT_LE((T.R() - Mat3::Identity()).norm(), 1e-12);
}

TEST(KittiPoses, RefusesBrokenFilesInOneSentence) {
  const TemporaryFolder folder;
  EXPECT_THAT(MessageOf<InputError>([&] { KittiFiles(folder.path(), "77"); }),
              HasSubstr("expected a KITTI odometry sequence"));
  EXPECT_THAT(MessageOf<InputError>([&] { ReadKittiCalibration(folder.path() / "calib.txt"); }),
              HasSubstr("expected a KITTI calib.txt"));
  const auto no_tr = folder.Write("calib.txt", "P0: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadKittiCalibration(no_tr); }),
              HasSubstr("no line begins with \"Tr:\""));
  const auto torn = folder.Write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0\n");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadKittiPoses(torn); }),
              HasSubstr("poses.txt:2: 8 numbers"));
  const auto gap =
      folder.Write("gap.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n\n1 0 0 0 0 1 0 0 0 0 1 0\n\n");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadKittiPoses(gap); }),
              HasSubstr("gap.txt:2: a blank line"));
  const auto words = folder.Write("poses.txt", "1 0 0 0 0 1 0 x 0 0 1 0\n");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadKittiPoses(words); }),
              HasSubstr("poses.txt:1: \"x\"; expected a number"));
  const auto scaled = folder.Write("poses.txt", "2 0 0 0 0 2 0 0 0 0 2 0\n");
  EXPECT_THAT(MessageOf<InputError>([&] { ReadKittiPoses(scaled); }), HasSubstr("not rigid"));
  folder.Write("sequences/03/calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  folder.Write("poses/03.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(MessageOf<InputError>([&] { OpenKittiSequence(folder.path(), "03").Motion(0, 1); }),
              HasSubstr("1 rows; expected a row for frame 1"));
}

// 00/95: a right turn of 1.24 degrees over 0.475 m (the data's own description).
TEST(KittiPoses, RealTurn) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::filesystem::path root = KittiRoot();
  const SE3d T = *OpenKittiSequence(root, "00").Motion(94, 95);
  EXPECT_NEAR(T.t().norm(), 0.475, 1e-3);
  EXPECT_NEAR(T.LogRotation().z() * 180 / M_PI, -1.24, 5e-3);
  EXPECT_GT(T.t().x(), 0.47);
}

}  // namespace
}  // namespace icpscape
