// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/resumable/resumable_odometry.h"

#include <gtest/gtest.h>

#include "icpscape/common/error.h"
#include "icpscape/io/kitti_writer.h"
#include "tests/odometry/drives.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing_support::Options;

// Four scans in a folder, and a journal.
class Resumable : public testing::Test {
 protected:
  Resumable() {
    for (int i = 0; i < 4; ++i) {
      const std::string name = std::to_string(i) + ".bin";
      WriteVelodyne(folder_.path() / name,
                    testing_support::FirstScans(4)[static_cast<std::size_t>(i)]);
    }
  }

  // Goes through the whole drive with this journal; returns how much was replayed and registered.
  std::pair<int, int> Drive(const std::string& journal_name, std::vector<FrameRecord>* records) {
    Journal journal(folder_.path() / journal_name, "header");
    ResumableOdometry odometry(OpenScanFolder(folder_.path()), Options(OdometryMode::kScanToMap),
                               0.5, &journal);
    std::pair<int, int> counts;
    odometry.Replay([&](int done) { counts.first = done; });
    odometry.Register([&](int done) { counts.second = done; });
    *records = odometry.records();
    map_points_ = odometry.map()->Cloud(SE3d()).size();
    return counts;
  }

  testing_support::TemporaryFolder folder_;
  std::size_t map_points_ = 0;
};

TEST_F(Resumable, GoesOnBitForBit) {
  std::vector<FrameRecord> whole, resumed;
  EXPECT_EQ(Drive("whole.txt", &whole), std::make_pair(0, 4));
  const std::size_t map_points = map_points_;
  // The header and two records.
  const std::string journal = testing_support::ReadFile(folder_.path() / "whole.txt");
  std::size_t end = 0;
  for (int line = 0; line < 3; ++line) {
    end = journal.find('\n', end) + 1;
  }
  folder_.Write("part.txt", journal.substr(0, end));
  EXPECT_EQ(Drive("part.txt", &resumed), std::make_pair(2, 2));
  ASSERT_EQ(resumed.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(resumed[i].result.T_world_lidar.Matrix(), whole[i].result.T_world_lidar.Matrix());
    EXPECT_EQ(resumed[i].result.n, whole[i].result.n);
    EXPECT_EQ(resumed[i].scan_sha256, whole[i].scan_sha256);
  }
  EXPECT_EQ(map_points_, map_points);
  EXPECT_GT(map_points, 1000U);
  EXPECT_LT(
      (testing_support::TownDrive().T_world_lidar[3].Inverse() * resumed[3].result.T_world_lidar)
          .t()
          .norm(),
      0.05);
}

// Scans 0, 1, 4 and 5, with their times beside them.
TEST_F(Resumable, GoesOnBehindAGap) {
  for (int i = 2; i < 4; ++i) {
    WriteVelodyne(folder_.path() / (std::to_string(i) + ".bin"),
                  testing_support::FirstScans(6)[static_cast<std::size_t>(i + 2)]);
  }
  folder_.Write("times.txt", "0\n0.1\n0.4\n0.5\n");
  std::vector<FrameRecord> whole, resumed;
  Drive("whole.txt", &whole);
  const std::string journal = testing_support::ReadFile(folder_.path() / "whole.txt");
  for (const int lines : {3, 4}) {
    std::size_t end = 0;
    for (int line = 0; line < lines; ++line) {
      end = journal.find('\n', end) + 1;
    }
    folder_.Write("part.txt", journal.substr(0, end));
    EXPECT_EQ(Drive("part.txt", &resumed), std::make_pair(lines - 1, 5 - lines));
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(resumed[i].result.T_world_lidar.Matrix(), whole[i].result.T_world_lidar.Matrix());
      EXPECT_EQ(resumed[i].result.iterations, whole[i].result.iterations);
    }
    std::filesystem::remove(folder_.path() / "part.txt");
  }
}

TEST_F(Resumable, NamesTheScanThatIsNotTheJournals) {
  std::vector<FrameRecord> records;
  Drive("journal.txt", &records);
  std::filesystem::copy_file(folder_.path() / "3.bin", folder_.path() / "2.bin",
                             std::filesystem::copy_options::overwrite_existing);
  const std::string message =
      testing_support::MessageOf<InputError>([&] { Drive("journal.txt", &records); });
  EXPECT_EQ(message, (folder_.path() / "2.bin").string() +
                         ": is not the scan of the journal; expected it unchanged, or a restart.");
}

}  // namespace
}  // namespace icpscape
