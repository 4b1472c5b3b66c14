// SPDX-License-Identifier: BSD-3-Clause
// WritePly of point_files.h.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <filesystem>

#include "icpscape/common/error.h"
#include "icpscape/io/point_files.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::MessageOf;
using testing_support::TemporaryFolder;

// On a full disk, which a limit on the size of files stands for.
TEST(WritePly, WritesAWholeFileOrNone) {
  const TemporaryFolder folder;
  const PointCloud cloud = testing_support::Room(3000, 1);
  WritePly(folder.path() / "old.ply", testing_support::Room(10, 1));
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little = {20000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &little);
  const std::string message =
      MessageOf<InputError>([&] { WritePly(folder.path() / "new.ply", cloud); });
  const std::string again =
      MessageOf<InputError>([&] { WritePly(folder.path() / "old.ply", cloud); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_THAT(message, HasSubstr("new.ply: cannot be written"));
  EXPECT_THAT(again, HasSubstr("old.ply: cannot be written"));
  DroppedPoints dropped;
  EXPECT_EQ(ReadPointFile(folder.path() / "old.ply", &dropped).size(), 10U);
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(WritePly, WritesDoublesFarOut) {
  const TemporaryFolder folder;
  PointCloud cloud;
  testing_support::AddPoint({0.25, -1.5, 3}, &cloud);
  testing_support::AddPoint({0.5, 1.5, -3}, &cloud);
  cloud.origin = {458000, 5429000, 100};
  WritePly(folder.path() / "far.ply", cloud);
  const std::string file = testing_support::ReadFile(folder.path() / "far.ply");
  EXPECT_THAT(file, HasSubstr("element vertex 2\nproperty double x\n"));
  const auto bytes = file.substr(file.find("end_header\n") + 11);
  ASSERT_EQ(bytes.size(), 48U);
  double values[6];
  std::memcpy(values, bytes.data(), sizeof values);
  EXPECT_THAT(values, testing::ElementsAre(458000.25, 5428998.5, 103, 458000.5, 5429001.5, 97));
}

}  // namespace
}  // namespace icpscape
