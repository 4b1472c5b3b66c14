// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/point_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <random>

#include "icpscape/common/error.h"
#include "tests/support/message_of.h"
#include "tests/support/point_file_writer.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::MessageOf;
using testing_support::PcdFile;
using testing_support::PcdHeader;
using testing_support::PlyFile;
using testing_support::TemporaryFolder;
using testing_support::TestField;

PointCloud Read(const std::filesystem::path& path) {
  DroppedPoints dropped;
  return ReadPointFile(path, &dropped);
}

// Numbers that every type down to 8 bits can hold, and that no two fields share; none is 0.
double ValueOf(const TestField& field, int i, int k) {
  const std::string name = field.name;
  if (name == "x" || name == "X") {
    return 1 + i;
  }
  if (name == "y" || name == "Y") {
    return 40 + 2 * (i % 20);
  }
  if (name == "z" || name == "Z") {
    return 90 + i % 7;
  }
  if (name == "intensity" || name == "reflectivity") {
    return k == 0 ? 5 * (i % 25) : 99;
  }
  if (name == "ring" || name == "line") {
    return i % 16;
  }
  if (name == "label") {
    return 3 + i % 4;
  }
  if (name.find("normal") == 0 || name[0] == 'n') {
    return name.back() == 'x' ? 3 : (name.back() == 'y' ? 0 : 4);
  }
  return 17 + k;  // What is to be skipped.
}

constexpr int kPoints = 60;

void ExpectTheCloud(const PointCloud& cloud, const std::vector<TestField>& fields,
                    const std::string& what) {
  ASSERT_EQ(cloud.size(), static_cast<std::size_t>(kPoints)) << what;
  const auto has = [&](const std::string& name) {
    return std::any_of(fields.begin(), fields.end(),
                       [&](const TestField& field) { return field.name == name; });
  };
  EXPECT_EQ(cloud.intensity.empty(), !has("intensity") && !has("reflectivity")) << what;
  EXPECT_EQ(cloud.ring.empty(), !has("ring") && !has("line")) << what;
  EXPECT_EQ(cloud.label.empty(), !has("label")) << what;
  EXPECT_EQ(cloud.nx.empty(), !has("nx") && !has("normal_x")) << what;
  for (int i = 0; i < kPoints; ++i) {
    const auto at = static_cast<std::size_t>(i);
    ASSERT_EQ(cloud.Point(at), Vec3(1 + i, 40 + 2 * (i % 20), 90 + i % 7)) << what << i;
    if (!cloud.intensity.empty()) {
      ASSERT_EQ(cloud.intensity[at], 5 * (i % 25)) << what << i;
    }
    if (!cloud.ring.empty()) {
      ASSERT_EQ(cloud.ring[at], i % 16) << what << i;
    }
    if (!cloud.label.empty()) {
      ASSERT_EQ(cloud.label[at], 3 + i % 4) << what << i;
    }
    if (!cloud.nx.empty()) {
      ASSERT_LE((cloud.Normal(at) - Vec3(0.6, 0, 0.8)).norm(), 1e-7) << what << i;
    }
  }
}

// Every layout in every encoding.
TEST(PointFiles, ReadsEveryLayoutInEveryEncoding) {
  const TestField x = {"x"}, y = {"y"}, z = {"z"};
  const std::vector<std::vector<TestField>> layouts = {
      {x, y, z},
      {{"x", 'F', 8}, {"y", 'F', 8}, {"z", 'F', 8}},
      {{"X"}, {"Y"}, {"Z"}, {"intensity"}},
      {{"intensity"}, z, y, x},
      {x, y, z, {"_", 'U', 1, 4}, {"intensity"}, {"ring", 'U', 2}, {"_", 'U', 1, 10}},
      {x, y, z, {"intensity", 'F', 4, 4}},
      {x, y, z, {"blue", 'U', 1}, {"green", 'U', 1}, {"red", 'U', 1}, {"intensity"}},
      {{"rgb"}, x, {"a", 'F', 8}, y, {"b", 'I', 8}, z, {"reflectivity", 'U', 2}},
      {{"x", 'I', 1}, {"y", 'U', 1}, {"z", 'I', 2}, {"intensity", 'U', 4}, {"label", 'U', 4}},
      {{"x", 'U', 2}, {"y", 'I', 4}, {"z", 'U', 4}, {"line", 'U', 1}, {"label", 'I', 4}},
      {{"x", 'I', 8}, {"y", 'U', 8}, {"z", 'F', 8}, {"ring", 'I', 8}},
      {x, y, z, {"normal_x"}, {"normal_y"}, {"normal_z"}, {"curvature"}},
      {x, y, z, {"nx", 'F', 8}, {"ny", 'F', 8}, {"nz", 'F', 8}, {"intensity", 'U', 1}}};
  const TemporaryFolder folder;
  int tried = 0;
  for (std::size_t l = 0; l < layouts.size(); ++l) {
    for (const char* data : {"ascii", "binary", "binary_compressed"}) {
      const std::string what = std::string(data) + " PCD, layout " + std::to_string(l) + ": ";
      ExpectTheCloud(Read(folder.Write("a.pcd", PcdFile(layouts[l], kPoints, ValueOf, data))),
                     layouts[l], what);
      ++tried;
    }
    // PLY has no counts: of several numbers the second becomes a property of another name.
    std::vector<TestField> fields;
    for (const TestField& field : layouts[l]) {
      fields.push_back(field);
      fields.back().count = 1;
      for (int k = 1; k < field.count; ++k) {
        fields.push_back({"skipped" + std::to_string(k), field.type, field.size});
      }
    }
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      ExpectTheCloud(Read(folder.Write("a.ply", PlyFile(fields, kPoints, ValueOf, format))), fields,
                     std::string(format) + " PLY, layout " + std::to_string(l) + ": ");
      ++tried;
    }
  }
  EXPECT_GE(tried, 40);
}

TEST(PointFiles, SkipsListsAndOtherElements) {
  const TemporaryFolder folder;
  const std::vector<TestField> fields = {
      {"x"}, {"views", 'U', 2, 5, true}, {"y"}, {"z", 'F', 8}, {"none", 'F', 8, 0, true}};
  const auto with_elements = [](std::string file, const std::string& row, bool text) {
    // A camera before the vertices, and faces behind them.
    const std::size_t vertex = file.find("element vertex");
    file.insert(vertex, "element camera 2\nproperty list uint8 uint8 d\nproperty uint8 n\n");
    const std::size_t end = file.find("end_header\n");
    file.insert(end, "element face 1\nproperty list uint8 uint8 vertex_indices\n");
    const std::size_t begin = file.find("end_header\n") + 11;
    file.insert(begin, row + row);
    return file + (text ? "3 0 1 2\n" : std::string("\3\0\1\2", 4));
  };
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const bool text = std::string(format) == "ascii";
    const std::string file = with_elements(PlyFile(fields, kPoints, ValueOf, format),
                                           text ? "2 7 7 1\n" : std::string("\2\7\7\1"), text);
    ExpectTheCloud(Read(folder.Write("a.ply", file)), {{"x"}, {"y"}, {"z"}}, format);
    EXPECT_THAT(MessageOf<InputError>(
                    [&] { Read(folder.Write("torn.ply", file.substr(0, file.size() - 4))); }),
                HasSubstr("torn.ply"));
  }
}

TEST(PointFiles, ReadsWhatOtherSystemsWrite) {
  const TemporaryFolder folder;
  const std::string rows = "1 2 3\n4 5 6\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nobj_info any\nelement vertex 2\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  const std::string pcd = PcdHeader({{"x"}, {"y"}, {"z"}}, 2, "ascii");
  const auto with_crlf = [](const std::string& text) {
    std::string out;
    for (const char c : text) {
      out += c == '\n' ? std::string("\r\n") : std::string(1, c);
    }
    return out;
  };
  for (const std::string& name : {std::string("a.ply"), std::string("A.PLY")}) {
    for (const std::string& text : {ply + rows, "\xEF\xBB\xBF" + ply + rows, with_crlf(ply + rows),
                                    ply + "+1 2.0 3e0\n\n 4\t5  6 \n\n", ply + "1 2 3\n4 5 6"}) {
      EXPECT_EQ(Read(folder.Write(name, text)).x, (std::vector<float>{1, 4})) << text;
    }
  }
  for (const std::string& name : {std::string("a.pcd"), std::string("a.Pcd")}) {
    for (const std::string& text :
         {pcd + rows, "\xEF\xBB\xBF" + pcd + rows, with_crlf(pcd + rows)}) {
      EXPECT_EQ(Read(folder.Write(name, text)).z, (std::vector<float>{3, 6})) << text;
    }
  }
  // A binary file whose header has other ends of lines.
  const std::string binary = PcdFile({{"x"}, {"y"}, {"z"}}, kPoints, ValueOf, "binary");
  const std::size_t begin = binary.find("DATA binary\n") + 12;
  ExpectTheCloud(
      Read(folder.Write("a.pcd", with_crlf(binary.substr(0, begin)) + binary.substr(begin))),
      {{"x"}, {"y"}, {"z"}}, "CRLF");
}

TEST(PointFiles, ReadsWordsThatAreNumbers) {
  const TemporaryFolder folder;
  DroppedPoints dropped;
  const std::string rows =
      "nan 1 1\ninf 1 1\n1 -inf 1\n1 1 -nan\n0 0 0\n-0 0 1e-400\n1e999 0 0\n2e9 0 0\n1e-310 2 3\n";
  const PointCloud cloud = ReadPointFile(
      folder.Write("a.pcd", PcdHeader({{"x"}, {"y"}, {"z"}}, 9, "ascii") + rows), &dropped);
  EXPECT_EQ(cloud.y, std::vector<float>{2});
  EXPECT_EQ(dropped.non_finite, 6U);
  EXPECT_EQ(dropped.zero, 2U);
}

TEST(PointFiles, ViewpointIsTheSensor) {
  const TemporaryFolder folder;
  std::string file = PcdFile({{"x"}, {"y"}, {"z"}}, kPoints, ValueOf, "binary");
  const std::string none = "VIEWPOINT 0 0 0 1 0 0 0";
  EXPECT_EQ(Read(folder.Write("a.pcd", file)).sensor, Vec3(0, 0, 0));
  // The rotation, about z by 90 degrees, turns no point.
  file.replace(file.find(none), none.size(), "VIEWPOINT 1.5 -2 3 0.7071068 0 0 0.7071068");
  const PointCloud cloud = Read(folder.Write("a.pcd", file));
  EXPECT_EQ(cloud.sensor, Vec3(1.5, -2, 3));
  EXPECT_EQ(cloud.Point(0), Vec3(1, 40, 90));
  // A place on a map is none in the frame of these points.
  file.replace(file.find("VIEWPOINT 1.5 -2 3"), 18, "VIEWPOINT 458000 5429000 3");
  EXPECT_EQ(Read(folder.Write("a.pcd", file)).sensor, Vec3(0, 0, 0));
}

// Times become seconds from the earliest.
TEST(PointFiles, TimesHaveTheirUnits) {
  const TemporaryFolder folder;
  const auto times = [&](TestField field, double first, double step) {
    const std::vector<TestField> fields = {{"x"}, {"y"}, {"z"}, field};
    const PointCloud cloud =
        Read(folder.Write("a.pcd", PcdFile(
                                       fields, kPoints,
                                       [&](const TestField& f, int i, int k) {
                                         return f.name == field.name
                                                    ? first + step * ((i + 7) % kPoints)
                                                    : ValueOf(f, i, k);
                                       },
                                       "binary")));
    EXPECT_EQ(cloud.time_s.size(), static_cast<std::size_t>(kPoints));
    return cloud.time_s;
  };
  for (const std::vector<float>& seconds :
       {times({"time", 'F', 4}, -0.05, 0.1 / 64), times({"t", 'U', 4}, 0, 1e8 / 64),
        times({"timestamp", 'F', 8}, 1.7e9, 0.1 / 64), times({"offset_time", 'U', 4}, 5, 1e8 / 64),
        times({"timestamp", 'U', 8}, 1.7e18, 1e8 / 64), times({"t", 'I', 4}, -7, 1e5 / 64),
        times({"TIME", 'F', 8}, 1.7e18, 1e8 / 64), times({"time", 'F', 4}, 0, 1e5 / 64)}) {
    for (int i = 0; i < kPoints; ++i) {
      EXPECT_NEAR(seconds[static_cast<std::size_t>(i)], 0.1 / 64 * ((i + 7) % kPoints), 2e-6) << i;
    }
  }
}

TEST(PointFiles, CoordinatesOfAPictureAreNoTimes) {
  const TemporaryFolder folder;
  const auto times = [&](const std::vector<TestField>& more) {
    std::vector<TestField> fields = {{"x"}, {"y"}, {"z"}};
    fields.insert(fields.end(), more.begin(), more.end());
    return Read(folder.Write("a.ply", PlyFile(fields, kPoints, ValueOf, "binary_little_endian")))
        .time_s.size();
  };
  EXPECT_EQ(times({{"s"}, {"t"}}), 0U);
  EXPECT_EQ(times({{"t"}}), static_cast<std::size_t>(kPoints));
  EXPECT_EQ(times({{"s"}, {"time"}}), static_cast<std::size_t>(kPoints));
}

TEST(PointFiles, RefusesFieldsThatAreNot) {
  const TemporaryFolder folder;
  const auto message = [&](const std::vector<TestField>& fields,
                           const testing_support::TestValues& values) {
    return MessageOf<InputError>(
        [&] { Read(folder.Write("a.pcd", PcdFile(fields, kPoints, values, "binary"))); });
  };
  EXPECT_THAT(message({{"x"}, {"y"}}, ValueOf), HasSubstr("a.pcd: no field z; expected x, y"));
  EXPECT_THAT(message({{"x"}, {"y"}, {"z"}, {"X"}}, ValueOf), HasSubstr("two fields x"));
  const auto constant = [](double value) {
    return [value](const TestField& f, int i, int k) {
      return f.name == "ring" || f.name == "label" ? value : ValueOf(f, i, k);
    };
  };
  EXPECT_THAT(message({{"x"}, {"y"}, {"z"}, {"ring"}}, constant(0.5)),
              HasSubstr("ring 0.5; expected a whole number from 0 to 65535"));
  EXPECT_THAT(message({{"x"}, {"y"}, {"z"}, {"ring", 'I', 4}}, constant(2147483647)),
              HasSubstr("expected a whole number from 0 to 65535"));
  EXPECT_THAT(message({{"x"}, {"y"}, {"z"}, {"label", 'F', 8}}, constant(5e9)),
              HasSubstr("label 5e+09; expected a whole number"));
}

// PCL's writers and readers on files of theirs.
TEST(PointFiles, AgreesWithPcl) {
  const TemporaryFolder folder;
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  std::mt19937 engine(3);
  std::normal_distribution<float> normal(0, 20);
  pcl::PointCloud<pcl::PointXYZI> points(40, 25);  // Organised, and much of it alike.
  for (pcl::PointXYZI& point : points) {
    point.x = normal(engine), point.y = 1.5F, point.z = normal(engine);
    point.intensity = 0.25F;
  }
  points.sensor_origin_ = {1, 2, 3, 0};
  const auto expect_the_points = [&](const std::string& name) {
    const PointCloud cloud = Read(folder.path() / name);
    ASSERT_EQ(cloud.size(), 1000U) << name;
    pcl::PointCloud<pcl::PointXYZI> theirs;
    const std::string path = (folder.path() / name).string();
    ASSERT_EQ(name.substr(name.size() - 3) == "ply" ? pcl::io::loadPLYFile(path, theirs)
                                                    : pcl::io::loadPCDFile(path, theirs),
              0);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      ASSERT_EQ(cloud.x[i], theirs[i].x) << name << i;
      ASSERT_EQ(cloud.y[i], theirs[i].y) << name << i;
      ASSERT_EQ(cloud.z[i], theirs[i].z) << name << i;
      ASSERT_EQ(cloud.intensity[i], theirs[i].intensity) << name << i;
    }
  };
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  pcl::io::savePCDFileASCII(path("ascii.pcd"), points);
  pcl::io::savePCDFileBinary(path("binary.pcd"), points);
  pcl::io::savePCDFileBinaryCompressed(path("compressed.pcd"), points);
  pcl::io::savePLYFileASCII(path("ascii.ply"), points);
  pcl::io::savePLYFileBinary(path("binary.ply"), points);
  for (const char* name :
       {"ascii.pcd", "binary.pcd", "compressed.pcd", "ascii.ply", "binary.ply"}) {
    expect_the_points(name);
  }
  EXPECT_EQ(Read(path("compressed.pcd")).sensor, Vec3(1, 2, 3));
  // And what we write.
  PointCloud cloud = testing_support::Room(1000, 1);
  cloud.intensity.assign(1000, 0.5F);
  WritePly(path("ours.ply"), cloud);
  expect_the_points("ours.ply");
}

}  // namespace
}  // namespace icpscape
