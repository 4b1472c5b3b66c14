// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/manifest.h"
#include "icpscape/io/output.h"
#include "icpscape/io/point_files.h"
#include "icpscape/io/transform.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::ReadFile;
using testing_support::TemporaryFolder;

template <class F>
std::string InputMessage(const F& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Text, NumbersReadBackExactly) {
  std::mt19937_64 engine(1);
  for (int i = 0; i < 1000; ++i) {
    const double value =
        std::ldexp(static_cast<double>(engine()), static_cast<int>(engine() % 100) - 80);
    EXPECT_EQ(std::stod(Number(value)), value);
  }
  EXPECT_EQ(Number(0.1), "0.1");
  EXPECT_EQ(Number(1), "1");
}

TEST(Transform, TextGoesRoundExactly) {
  const TemporaryFolder folder;
  const SE3d T = SE3d::Exp((Vec6() << 0.1, -0.2, 0.3, 1, 2, 3).finished());
  WriteTextFile(folder.path() / "T.txt", FormatTransform(T));
  const SE3d back = ReadTransform(folder.path() / "T.txt");
  EXPECT_EQ(back.t(), T.t());
  EXPECT_LE((back.R() - T.R()).norm(), 1e-15);
}

TEST(Transform, RefusesWhatIsNotRigid) {
  const auto message = [](const std::string& text) {
    return InputMessage([&] { ParseTransform(text, "place"); });
  };
  EXPECT_THAT(message("1 2 3"), HasSubstr("place: 3 numbers; expected a 3x4 or 4x4"));
  EXPECT_THAT(message("1 0 0 0 0 1 0 0 0 0 1.1 0"), HasSubstr("not rigid"));
  EXPECT_THAT(message("-1 0 0 0 0 1 0 0 0 0 1 0"), HasSubstr("not rigid"));  // A reflection.
  EXPECT_THAT(message("1 0 0 nan 0 1 0 0 0 0 1 0"), HasSubstr("not rigid"));
  EXPECT_THAT(message("nan 0 0 0 0 1 0 0 0 0 1 0"), HasSubstr("not rigid"));
  EXPECT_THAT(message("1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1"), HasSubstr("last row"));
  EXPECT_THAT(message("1 0 0 0 0 1 0 0 0 0 1e 0"), HasSubstr("\"1e\"; expected a number"));
  EXPECT_THAT(InputMessage([] { ReadTransform("/nowhere/T.txt"); }), HasSubstr("cannot be read"));
}

// R^T R may be off by 1e-3: a scale of 1 + e makes that 2 sqrt(3) e. What is taken is made rigid.
TEST(Transform, TakesTheRoundingOfText) {
  const auto scaled = [](double s) {
    const std::string d = Number(s);
    return d + " 0 0 1 0 " + d + " 0 2 0 0 " + d + " 3";
  };
  const SE3d T = ParseTransform(scaled(1.00028), "place");
  EXPECT_LE((T.R() - Mat3::Identity()).norm(), 1e-12);
  EXPECT_EQ(T.t(), Vec3(1, 2, 3));
  EXPECT_THAT(InputMessage([&] { ParseTransform(scaled(1.0003), "place"); }),
              HasSubstr("not rigid"));
}

TEST(PointFiles, PlyGoesRound) {
  const TemporaryFolder folder;
  PointCloud cloud = testing_support::Room(100, 1);
  for (int i = 0; i < 100; ++i) {
    cloud.intensity.push_back(static_cast<float>(i) / 128);
  }
  WritePly(folder.path() / "room.ply", cloud);
  DroppedPoints dropped;
  const PointCloud back = ReadPointFile(folder.path() / "room.ply", &dropped);
  EXPECT_EQ(back.x, cloud.x);
  EXPECT_EQ(back.y, cloud.y);
  EXPECT_EQ(back.z, cloud.z);
  EXPECT_EQ(back.intensity, cloud.intensity);
}

TEST(PointFiles, RefusesBrokenFiles) {
  const TemporaryFolder folder;
  DroppedPoints dropped;
  const auto message = [&](const std::filesystem::path& path) {
    return InputMessage([&] { ReadPointFile(path, &dropped); });
  };
  EXPECT_THAT(message(folder.path() / "none.ply"), HasSubstr("none.ply: cannot be read"));
  EXPECT_THAT(message(folder.path() / "none.bin"), HasSubstr("none.bin: cannot be read"));
  EXPECT_THAT(message(folder.Write("a.las", "1 2 3")),
              HasSubstr("expected one of .bin, .pcd, .ply, .npy"));
  WritePly(folder.path() / "whole.ply", testing_support::Room(100, 1));
  const std::string whole = ReadFile(folder.path() / "whole.ply");
  const auto torn = folder.Write("torn.ply", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(message(torn), HasSubstr("torn.ply"));
}

TEST(Output, FilesAppearWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const auto path = folder.Write("table.csv", "old");
  EXPECT_THAT(InputMessage([&] {
                WriteThenRename(path, [&](const std::filesystem::path& part) {
                  testing_support::ReadFile(part);
                  return false;
                });
              }),
              HasSubstr("cannot be written"));
  EXPECT_EQ(ReadFile(path), "old");
  WriteTextFile(path, "new");
  EXPECT_EQ(ReadFile(path), "new");
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    (void)entry;
    ++files;
  }
  EXPECT_EQ(files, 1);
}

TEST(Output, FolderMustBeWritable) {
  const TemporaryFolder folder;
  const auto file = folder.Write("file", "");
  EXPECT_THAT(InputMessage([&] { PrepareOutputFolder(file / "below"); }),
              HasSubstr("cannot be written"));
  PrepareOutputFolder(folder.path() / "a/b");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "a/b"));
}

TEST(Output, TablesRefuseRowsOfOtherLengths) {
  Table table({"a", "b"});
  table.AddRow({"1", "2"});
  EXPECT_EQ(testing_support::MessageOf<UsageError>([&] { table.AddRow({"3"}); }),
            "A row of 1 cells; expected one for each of 2 columns.");
}

TEST(Manifest, SaysWhatTookHowLong) {
  Manifest manifest("test");
  EXPECT_EQ(manifest.TimingsText(), "");
  // Each is what went by since the one before: "draw" no more than the time around it.
  const auto sleep = [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); };
  const auto now = [] { return std::chrono::steady_clock::now(); };
  sleep();
  const auto before = now();
  manifest.AddTiming("read");
  sleep();
  manifest.AddTiming("draw");
  const double around_s = std::chrono::duration<double>(now() - before).count();
  EXPECT_THAT(manifest.TimingsText(), testing::MatchesRegex("read [0-9.]+ s, draw [0-9.]+ s"));
  const TemporaryFolder folder;
  manifest.Write(folder.path() / "manifest.json");
  const auto timings =
      nlohmann::json::parse(ReadFile(folder.path() / "manifest.json"))["timings_s"];
  EXPECT_GE(timings["read"].get<double>(), 0.02);
  EXPECT_GE(timings["draw"].get<double>(), 0.02);
  EXPECT_LE(timings["draw"].get<double>(), around_s);
}

TEST(Manifest, HashesInputs) {
  const TemporaryFolder folder;
  Manifest manifest("test");
  manifest.AddInput(folder.Write("abc", "abc"));
  manifest.SetFlag("samples", "100", false);
  manifest.SetFlag("voxel_m", "0.5", true);
  manifest.Write(folder.path() / "manifest.json");
  const auto json = nlohmann::json::parse(ReadFile(folder.path() / "manifest.json"));
  // The first test vector of FIPS 180-2.
  EXPECT_EQ(json["inputs"][(folder.path() / "abc").string()]["sha256"],
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(json["flags"]["samples"], "100");
  EXPECT_EQ(json["flags"]["voxel_m"], "0.5");
  EXPECT_EQ(json["changed_flags"], nlohmann::json({{"voxel_m", "0.5"}}));
  EXPECT_THAT(json["version"].get<std::string>(), testing::StartsWith("0."));
}

TEST(Manifest, ListsFilesForTheSameProgramAlone) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "manifest.json";
  EXPECT_FALSE(FilesOfManifest(path, "test").has_value());
  Manifest manifest("test");
  manifest.SetFiles({"curves.csv", "data/1.txt"});
  manifest.Write(path);
  EXPECT_THAT(FilesOfManifest(path, "test").value(),
              testing::ElementsAre("curves.csv", "data/1.txt"));
  EXPECT_FALSE(FilesOfManifest(path, "another").has_value());
  // Manifests of an earlier version, without files, and of no program.
  folder.Write("manifest.json", R"({"program": "test"})");
  EXPECT_TRUE(FilesOfManifest(path, "test").value().empty());
  folder.Write("manifest.json", R"({"program": "test", "files": ["a.csv", 3]})");
  EXPECT_THAT(FilesOfManifest(path, "test").value(), testing::ElementsAre("a.csv"));
  folder.Write("manifest.json", "no JSON");
  EXPECT_FALSE(FilesOfManifest(path, "test").has_value());
}

}  // namespace
}  // namespace icpscape
