// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/sequences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "icpscape/io/kitti.h"
#include "tests/support/message_of.h"
#include "tests/support/real_scans.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_support::MessageOf;
using testing_support::TemporaryFolder;

std::vector<std::string> NamesOf(const ScanSequence& sequence) {
  std::vector<std::string> names;
  for (const auto& scan : sequence.scans) {
    names.push_back(scan.name);
  }
  return names;
}

class ScanSequenceTest : public testing::Test {
 protected:
  // Scans are not opened here: empty ones will do.
  void WriteScans(const std::string& folder, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      folder_.Write(folder + "/" + name, "");
    }
  }
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }
  std::string KittiMessage(const FrameRange& frames = {}) const {
    return MessageOf([&] { OpenKittiSequence(folder_.path(), "03").Frames(frames); });
  }
  std::string FolderMessage(const std::string& folder, const FrameRange& frames = {}) const {
    return MessageOf([&] { OpenScanFolder(Path(folder)).Frames(frames); });
  }

  // Four scans; the camera looks along the lidar's x axis and drives 1 m a frame.
  void WriteKitti() {
    WriteScans("sequences/03/velodyne", {"000000.bin", "000001.bin", "000002.bin", "000003.bin"});
    folder_.Write("sequences/03/times.txt", "0.000000e+00\n1.035e-01\n2.07e-01\n3.2e-01\n");
    folder_.Write("sequences/03/calib.txt", "P0: 1\nTr: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 0.3\n");
    std::string poses;
    for (const char* z : {"5", "6", "7", "8"}) {
      poses += std::string("1 0 0 0 0 1 0 0 0 0 1 ") + z + "\n";
    }
    folder_.Write("poses/03.txt", poses);
  }

  TemporaryFolder folder_;
};

TEST_F(ScanSequenceTest, OpensAKittiSequence) {
  WriteKitti();
  const ScanSequence sequence = OpenKittiSequence(folder_.path(), "03");
  EXPECT_EQ(sequence.title, "KITTI 03");
  EXPECT_THAT(NamesOf(sequence),
              ElementsAre("000000.bin", "000001.bin", "000002.bin", "000003.bin"));
  EXPECT_TRUE(std::filesystem::exists(sequence.scans[3].file));
  EXPECT_THAT(sequence.times_s, ElementsAre(0, 0.1035, 0.207, 0.32));
  EXPECT_TRUE(sequence.times_are_measured);
  ASSERT_EQ(sequence.T_world_lidar.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {  // Forward is the lidar's x.
    const Vec3 moved = (sequence.T_world_lidar[0].Inverse() * sequence.T_world_lidar[i]).t();
    EXPECT_NEAR((moved - Vec3(static_cast<double>(i), 0, 0)).norm(), 0, 1e-12);
  }
  ASSERT_TRUE(sequence.T_camera_lidar);
  EXPECT_NEAR((*sequence.T_camera_lidar * Vec3(1, 2, 3) - Vec3(-1.9, -2.8, 1.3)).norm(), 0, 1e-12);
}

TEST_F(ScanSequenceTest, TakesARangeOfAKittiSequence) {
  WriteKitti();
  const ScanSequence all = OpenKittiSequence(folder_.path(), "03");
  const ScanSequence part = OpenKittiSequence(folder_.path(), "03").Frames({1, 2});
  EXPECT_THAT(NamesOf(part), ElementsAre("000001.bin", "000002.bin"));
  EXPECT_THAT(part.times_s, ElementsAre(0.1035, 0.207));
  ASSERT_EQ(part.T_world_lidar.size(), 2U);
  EXPECT_EQ(part.T_world_lidar[0].Matrix(), all.T_world_lidar[1].Matrix());
  EXPECT_THAT(NamesOf(OpenKittiSequence(folder_.path(), "03").Frames({2, -1})),
              ElementsAre("000002.bin", "000003.bin"));
}

TEST_F(ScanSequenceTest, DoesWithoutTimesCalibrationAndPoses) {
  WriteKitti();
  std::filesystem::remove(Path("sequences/03/times.txt"));
  std::filesystem::remove(Path("poses/03.txt"));
  ScanSequence sequence = OpenKittiSequence(folder_.path(), "03").Frames({1, 3});
  EXPECT_FALSE(sequence.times_are_measured);
  EXPECT_THAT(sequence.times_s, ElementsAre(0.1, 0.2, 3 * 0.1));
  EXPECT_THAT(sequence.T_world_lidar, IsEmpty());
  EXPECT_TRUE(sequence.T_camera_lidar);
  std::filesystem::remove(Path("sequences/03/calib.txt"));
  EXPECT_FALSE(OpenKittiSequence(folder_.path(), "03").T_camera_lidar);
}

TEST_F(ScanSequenceTest, NamesWhatAKittiSequenceLacks) {
  EXPECT_THAT(KittiMessage(), HasSubstr("sequences/03: no such folder"));
  std::filesystem::create_directories(Path("sequences/03"));
  EXPECT_THAT(KittiMessage(), HasSubstr("03/velodyne: 0 scans; expected frames"));
  WriteKitti();
  EXPECT_THAT(KittiMessage({1, 4}), HasSubstr("03/velodyne: 4 scans; expected frames within 0:3."));
  EXPECT_THAT(KittiMessage({7, -1}), HasSubstr("4 scans; expected frames within 0:3."));
  EXPECT_THAT(KittiMessage({0, 2000000000}), HasSubstr("4 scans"));
  std::filesystem::remove(Path("sequences/03/velodyne/000001.bin"));
  EXPECT_THAT(KittiMessage(),
              HasSubstr("000001.bin: no such scan; expected all of the frames 0:3."));
  EXPECT_THAT(KittiMessage({2, 3}), HasSubstr("nothing was thrown"));
}

TEST_F(ScanSequenceTest, PassesOverForeignFilesOfAKittiSequence) {
  WriteKitti();
  WriteScans("sequences/03/velodyne", {"notes.txt", "old.bin", "7.bin", "99999999999.bin"});
  EXPECT_EQ(OpenKittiSequence(folder_.path(), "03").scans.size(), 4U);
  std::filesystem::remove_all(Path("sequences/03/velodyne"));
  WriteScans("sequences/03/velodyne", {"old.bin"});
  EXPECT_THAT(KittiMessage(), HasSubstr("03/velodyne: 0 scans"));
}

TEST_F(ScanSequenceTest, RefusesShortAndMalformedKittiFiles) {
  WriteKitti();
  folder_.Write("poses/03.txt", "1 0 0 0 0 1 0 0 0 0 1 5\n1 0 0 0 0 1 0 0 0 0 1 6\n");
  EXPECT_THAT(KittiMessage({0, 2}), HasSubstr("03.txt: 2 rows; expected a row for frame 2."));
  EXPECT_EQ(OpenKittiSequence(folder_.path(), "03").Frames({0, 1}).T_world_lidar.size(), 2U);
  folder_.Write("sequences/03/times.txt", "0\n0.1\n0.2\n");
  EXPECT_THAT(KittiMessage({1, 3}), HasSubstr("times.txt: no time for 000003.bin;"));
  for (const char* bad : {"0\n0.1\n0.1\n0.2\n", "0\n0.1\nsoon\n0.2\n", "0\n0.1\nnan\n0.2\n",
                          "0\n0.1\n0.2 0.3\n0.4\n"}) {
    folder_.Write("sequences/03/times.txt", bad);
    EXPECT_THAT(KittiMessage(),
                AllOf(HasSubstr("times.txt:3: \""), EndsWith("a time after the one before.")))
        << bad;
  }
  folder_.Write("sequences/03/times.txt", "0\n\n0.1\n0.2\n0.3\n");
  EXPECT_THAT(KittiMessage(), HasSubstr("times.txt: no time for 000001.bin;"));
}

TEST_F(ScanSequenceTest, OrdersAFolderByNumber) {
  WriteScans("drive", {"10.pcd", "2.pcd", "1.pcd", "notes.txt", "0.pcd"});
  const ScanSequence sequence = OpenScanFolder(Path("drive"));
  EXPECT_EQ(sequence.title, "drive");
  EXPECT_THAT(NamesOf(sequence), ElementsAre("0.pcd", "1.pcd", "2.pcd", "10.pcd"));
  EXPECT_THAT(sequence.times_s, ElementsAre(0, 0.1, 0.2, 1));  // 3 to 9 are missing.
  EXPECT_FALSE(sequence.times_are_measured);
  EXPECT_THAT(sequence.T_world_lidar, IsEmpty());
  EXPECT_FALSE(sequence.T_camera_lidar);
  EXPECT_EQ(OpenScanFolder(folder_.path().string() + "/drive/").title, "drive");
}

TEST_F(ScanSequenceTest, OrdersAFolderByTimeStampsAndByName) {
  WriteScans("stamped", {"1317617736.05.ply", "1317617735.9.ply", "1317617736.15.ply"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("stamped"))),
              ElementsAre("1317617735.9.ply", "1317617736.05.ply", "1317617736.15.ply"));
  WriteScans("named", {"scan_b.bin", "scan_c.bin", "scan_a.bin", "7.bin"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("named"))),
              ElementsAre("7.bin", "scan_a.bin", "scan_b.bin", "scan_c.bin"));
}

TEST_F(ScanSequenceTest, OrdersAFolderNaturally) {
  WriteScans("unpadded", {"scan_10.pcd", "scan_2.pcd", "scan_1.pcd", "scan_11.pcd"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("unpadded"))),
              ElementsAre("scan_1.pcd", "scan_2.pcd", "scan_10.pcd", "scan_11.pcd"));
  WriteScans("numbers", {"run2_9.ply", "Run10_1.ply", "run2_10.ply", "run2.ply"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("numbers"))),
              ElementsAre("run2.ply", "run2_9.ply", "run2_10.ply", "Run10_1.ply"));
}

// Stamps need not have equally many digits behind their point, nor be without letters.
TEST_F(ScanSequenceTest, OrdersAFolderByNumbersBehindLetters) {
  WriteScans("stamped",
             {"lidar_1317617736.05.ply", "lidar_1317617735.9.ply", "lidar_1317617735.85.ply"});
  EXPECT_THAT(
      NamesOf(OpenScanFolder(Path("stamped"))),
      ElementsAre("lidar_1317617735.85.ply", "lidar_1317617735.9.ply", "lidar_1317617736.05.ply"));
  WriteScans("negative", {"-1.5.ply", "-2.ply", "1.ply", "0.5.ply"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("negative"))),
              ElementsAre("-2.ply", "-1.5.ply", "0.5.ply", "1.ply"));
  WriteScans("equal", {"010.ply", "10.ply", "9.ply", "011.ply"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("equal"))),
              ElementsAre("9.ply", "010.ply", "10.ply", "011.ply"));
}

// An unfinished file of ours, and one of a Mac's.
TEST_F(ScanSequenceTest, PassesOverHiddenFiles) {
  WriteScans("drive", {"0.bin", "1.bin", ".1234.2.bin", "._1.bin", "._1.pcd"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("drive"))), ElementsAre("0.bin", "1.bin"));
  WriteScans("hidden", {".0.bin"});
  EXPECT_THAT(FolderMessage("hidden"), HasSubstr("hidden: no scan"));
  WriteScans("raw/velodyne_points/data", {"0000000000.bin", ".77.0000000001.bin"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("raw"))), ElementsAre("0000000000.bin"));
}

TEST_F(ScanSequenceTest, FindsTheTimesOfAFolder) {
  WriteScans("drive", {"scan_7.bin", "scan_8.bin", "scan_12.bin"});
  ScanSequence sequence = OpenScanFolder(Path("drive"));
  EXPECT_THAT(sequence.times_s, ElementsAre(0, 0.1, 0.5));
  EXPECT_EQ(sequence.TimesText(), "numbers of the scans, taken as 10 Hz, 1 gap of 0.4 s");
  folder_.Write("drive/times.txt", "3\n3.5\n4\n");
  sequence = OpenScanFolder(Path("drive"));
  EXPECT_THAT(sequence.times_s, ElementsAre(3, 3.5, 4));
  EXPECT_TRUE(sequence.times_are_measured);
  EXPECT_EQ(sequence.TimesText(), "times.txt");
  EXPECT_THAT(sequence.inputs, ElementsAre(Path("drive/times.txt")));
  folder_.Write("drive/times.txt", "3\n3.5\n");
  EXPECT_THAT(FolderMessage("drive"), HasSubstr("2 times; expected one for each of the 3 scans"));
  WriteScans("stamped", {"1403636579763555584.bin", "1403636579863555584.bin"});
  sequence = OpenScanFolder(Path("stamped"));
  EXPECT_TRUE(sequence.times_are_measured);
  EXPECT_NEAR(sequence.times_s[1] - sequence.times_s[0], 0.1, 1e-6);
}

TEST_F(ScanSequenceTest, TakesARangeOfAFolder) {
  WriteScans("drive", {"10.bin", "20.bin", "30.bin"});
  const ScanSequence part = OpenScanFolder(Path("drive")).Frames({1, 2});  // Counted, not named.
  EXPECT_THAT(NamesOf(part), ElementsAre("20.bin", "30.bin"));
  EXPECT_THAT(part.times_s, ElementsAre(0.1, 0.2));
  EXPECT_EQ(OpenScanFolder(Path("drive")).Frames({2, -1}).scans.size(), 1U);
  EXPECT_THAT(FolderMessage("drive", {1, 3}),
              EndsWith("drive: 3 scans; expected frames within 0:2."));
  EXPECT_THAT(FolderMessage("drive", {3, -1}), HasSubstr("3 scans"));
}

TEST_F(ScanSequenceTest, TakesExtensionsInUpperCase) {
  WriteScans("drive", {"0.pcd", "1.PCD", "2.Pcd"});
  EXPECT_THAT(NamesOf(OpenScanFolder(Path("drive"))), ElementsAre("0.pcd", "1.PCD", "2.Pcd"));
}

TEST_F(ScanSequenceTest, RefusesFoldersWithoutOneKindOfScan) {
  EXPECT_THAT(FolderMessage("missing"), HasSubstr("missing: no scan; expected a folder of .bin"));
  std::filesystem::create_directories(Path("empty"));
  EXPECT_THAT(FolderMessage("empty"), HasSubstr("empty: no scan"));
  WriteScans("mixed", {"0.bin", "1.ply", "2.pcd", "3.ply"});
  EXPECT_THAT(FolderMessage("mixed"),
              EndsWith("mixed: holds .bin and .pcd and .ply files; expected scans of one kind."));
}

TEST_F(ScanSequenceTest, OpensARawDrive) {
  WriteScans("drive/velodyne_points/data", {"0000000000.bin", "0000000001.bin", "0000000002.bin"});
  ScanSequence sequence = OpenScanFolder(Path("drive"));
  EXPECT_EQ(sequence.title, "drive");
  EXPECT_EQ(sequence.scans[1].file, Path("drive/velodyne_points/data/0000000001.bin"));
  EXPECT_FALSE(sequence.times_are_measured);
  EXPECT_THAT(sequence.times_s, ElementsAre(0, 0.1, 0.2));
  // Over midnight; of nine digits a double holds seven beside a month's seconds.
  folder_.Write("drive/velodyne_points/timestamps.txt",
                "2011-09-26 23:59:59.900000000\r\n2011-09-27 00:00:00.003456789\n"
                "2011-09-27 00:00:00.110000000\n\n");
  sequence = OpenScanFolder(Path("drive")).Frames({1, 2});
  EXPECT_TRUE(sequence.times_are_measured);
  ASSERT_EQ(sequence.times_s.size(), 2U);
  EXPECT_NEAR(sequence.times_s[0], 0.103456789, 1e-9);
  EXPECT_NEAR(sequence.times_s[1], 0.21, 1e-9);
}

// KITTI's raw drive 2011_09_26 0009 has no scans 177 to 180, and blank lines for their times.
TEST_F(ScanSequenceTest, GivesRawScansTheTimeOfTheirNumber) {
  WriteScans("drive/velodyne_points/data", {"0000000001.bin", "0000000002.bin", "0000000004.bin"});
  EXPECT_THAT(OpenScanFolder(Path("drive")).times_s, ElementsAre(0.1, 0.2, 0.4));
  const auto write_times = [&](const std::string& text) {
    folder_.Write("drive/velodyne_points/timestamps.txt", text);
  };
  write_times("5\n5.25\n5.5\n5.75\n6.5\n");
  EXPECT_THAT(OpenScanFolder(Path("drive")).times_s, ElementsAre(0.25, 0.5, 1.5));
  EXPECT_THAT(OpenScanFolder(Path("drive")).Frames({2, 2}).times_s, ElementsAre(1.5));
  write_times("\n5.25\n5.5\n\r\n6.5\n");
  EXPECT_THAT(OpenScanFolder(Path("drive")).times_s, ElementsAre(0, 0.25, 1.25));
  write_times("5\n5.25\n5.5\n5.75\n");
  EXPECT_THAT(FolderMessage("drive"), HasSubstr("timestamps.txt: no time for 0000000004.bin;"));
  write_times("5\n5.25\n\n5.75\n6.5\n");
  EXPECT_THAT(FolderMessage("drive"), HasSubstr("timestamps.txt: no time for 0000000002.bin;"));
  write_times("5\n5.25\n\n5.25\n6.5\n");
  EXPECT_THAT(FolderMessage("drive"), HasSubstr("timestamps.txt:4: \"5.25\""));
  write_times("5\n5.25\n2011-09-26\n5.75\n");
  EXPECT_THAT(FolderMessage("drive"), HasSubstr("timestamps.txt:3: \"2011-09-26\""));
  WriteScans("drive/velodyne_points/data", {"copy.bin"});
  EXPECT_THAT(FolderMessage("drive"), HasSubstr("copy.bin: no scan of a raw drive"));
}

TEST_F(ScanSequenceTest, IsTurnedAround) {
  WriteKitti();
  const ScanSequence forwards = OpenKittiSequence(folder_.path(), "03");
  ScanSequence sequence = forwards;
  sequence.Reverse();
  EXPECT_EQ(sequence.title, "KITTI 03 reversed");
  EXPECT_THAT(NamesOf(sequence),
              ElementsAre("000003.bin", "000002.bin", "000001.bin", "000000.bin"));
  // Time still goes forwards, from gap to gap the other way.
  EXPECT_THAT(sequence.times_s, ElementsAre(0, testing::DoubleNear(0.113, 1e-12),
                                            testing::DoubleNear(0.2165, 1e-12), 0.32));
  EXPECT_EQ(sequence.T_world_lidar[0].Matrix(), forwards.T_world_lidar[3].Matrix());
  EXPECT_EQ(sequence.T_world_lidar[3].Matrix(), forwards.T_world_lidar[0].Matrix());
}

TEST(RealScanSequences, Open) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const ScanSequence seven = OpenKittiSequence(KittiRoot(), "07").Frames({0, 4});
  ASSERT_EQ(seven.scans.size(), 5U);
  EXPECT_NEAR((seven.T_world_lidar[0].Inverse() * seven.T_world_lidar[4]).t().norm(),
              (*OpenKittiSequence(KittiRoot(), "07").Motion(0, 4)).t().norm(), 1e-9);
  const std::filesystem::path drive = KittiRoot() / "raw/2011_09_26/drive_0048";
  if (std::filesystem::is_directory(drive)) {
    EXPECT_EQ(OpenScanFolder(drive).scans.size(), 22U);
  }
}

}  // namespace
}  // namespace icpscape
