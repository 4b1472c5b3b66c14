// SPDX-License-Identifier: BSD-3-Clause
// Clouds in tables: .csv, .txt, .xyz and .npy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "icpscape/common/error.h"
#include "icpscape/io/point_files.h"
#include "tests/support/message_of.h"
#include "tests/support/point_file_writer.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing_support::AppendAs;
using testing_support::MessageOf;
using testing_support::TemporaryFolder;

PointCloud Read(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  DroppedPoints dropped;
  return ReadPointFile(folder.Write(name, content), &dropped);
}

std::string MessageOn(const std::string& name, const std::string& content) {
  return MessageOf<InputError>([&] { Read(name, content); });
}

TEST(Tables, TextHasNames) {
  for (const std::string& text :
       {std::string("time,Z,intensity,y,x\n0.5,3,7,2,1\n0.25,6,8,5,4\n"),
        std::string("// a comment\n#time;z;intensity;y;x\r\n0.5; 3;7;2 ;1\r\n0.25;6;8;5;4\r\n"),
        std::string("\n//time z\t\"intensity\"  Y X\n\n0.5 3 7 2 1\n 0.25\t6 8 5 4"),
        std::string("\xEF\xBB\xBF\"time\",\"z\",\"intensity\",\"y\",\"x\"\n0.5,3,7,2,1\n"
                    "0.25,6,8,5,4\n")}) {
    for (const char* name : {"a.csv", "a.txt", "a.XYZ"}) {
      const PointCloud cloud = Read(name, text);
      EXPECT_THAT(cloud.x, ElementsAre(1, 4)) << text;
      EXPECT_THAT(cloud.y, ElementsAre(2, 5)) << text;
      EXPECT_THAT(cloud.z, ElementsAre(3, 6)) << text;
      EXPECT_THAT(cloud.intensity, ElementsAre(7, 8)) << text;
      EXPECT_THAT(cloud.time_s, ElementsAre(0.25F, 0)) << text;
    }
  }
  const PointCloud cloud = Read("a.xyz", "# no names\n1 2 3 255 0 0\n4 5 6 0 0 0\n");
  EXPECT_THAT(cloud.z, ElementsAre(3, 6));
  EXPECT_TRUE(cloud.intensity.empty());
}

TEST(Tables, TextIsRefusedByLine) {
  EXPECT_THAT(MessageOn("a.csv", "1,2,3\n4,5,6\n"),
              HasSubstr("a.csv:1: \"1\"; expected a line of names, x, y and z among them."));
  EXPECT_THAT(MessageOn("a.csv", "x,y,i\n1,2,3\n"), HasSubstr("a.csv:1: \"x\"; expected a line"));
  EXPECT_THAT(MessageOn("a.csv", "x,y,z\n1,2,3\n4,5\n"), HasSubstr("a.csv:3: a line of 2 numbers"));
  EXPECT_THAT(MessageOn("a.csv", "x,y,z\n1,,3\n"), HasSubstr("a.csv:2: \"\"; expected a number"));
  EXPECT_THAT(MessageOn("a.csv", "x;y;z\n1,5;2;3\n"), HasSubstr("a.csv:2: \"1,5\""));
  EXPECT_THAT(MessageOn("a.xyz", "1,5 2,5 3,5\n"), HasSubstr("a.xyz:1: "));
  EXPECT_THAT(MessageOn("a.xyz", "foo bar baz\n"), HasSubstr("a.xyz:1: \"foo\""));
  EXPECT_THAT(MessageOn("a.txt", "x y z\n"), HasSubstr("no usable point among 0"));
  EXPECT_THAT(MessageOn("a.txt", "# only\n"), HasSubstr("no points"));
}

// What numpy.save writes: a header of a multiple of 64 bytes, and the numbers.
std::string Npy(const std::string& descr, const std::string& shape, const std::string& data,
                bool fortran = false) {
  std::string header = "{'descr': " + descr + ", 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
  header.resize((10 + header.size() + 64) / 64 * 64 - 11, ' ');
  header += "\n";
  std::string file = "\x93NUMPY\x01";
  file += '\0';
  AppendAs<std::uint16_t>(static_cast<double>(header.size()), false, &file);
  return file + header + data;
}

template <class T>
std::string Numbers(const std::vector<double>& values, bool big_endian = false) {
  std::string bytes;
  for (const double value : values) {
    AppendAs<T>(value, big_endian, &bytes);
  }
  return bytes;
}

TEST(Tables, NpyArrays) {
  const std::vector<double> rows = {1, 2, 3, 9, 4, 5, 6, 8}, columns = {1, 4, 2, 5, 3, 6, 9, 8};
  for (const std::string& file :
       {Npy("'<f4'", "(2, 4)", Numbers<float>(rows)), Npy("'<f8'", "(2, 4)", Numbers<double>(rows)),
        Npy("'>f4'", "(2, 4)", Numbers<float>(rows, true)),
        Npy("'<i2'", "(2, 4)", Numbers<std::int16_t>(rows)),
        Npy("'<f4'", "(2, 4)", Numbers<float>(columns), true)}) {
    const PointCloud cloud = Read("a.npy", file);
    EXPECT_THAT(cloud.x, ElementsAre(1, 4));
    EXPECT_THAT(cloud.y, ElementsAre(2, 5));
    EXPECT_THAT(cloud.z, ElementsAre(3, 6));
    EXPECT_THAT(cloud.intensity, ElementsAre(9, 8));
  }
  const PointCloud five =
      Read("a.npy", Npy("'<f4'", "(2, 5)", Numbers<float>({1, 2, 3, 9, 9, 4, 5, 6, 9, 9})));
  EXPECT_THAT(five.z, ElementsAre(3, 6));
  EXPECT_TRUE(five.intensity.empty());
}

TEST(Tables, NpyRecordsHaveNames) {
  std::string data;
  for (const double i : {0, 3}) {
    data += Numbers<double>({1 + i, 2 + i}) + "pad!" + Numbers<float>({7, 7}) +
            Numbers<std::uint16_t>({i}) + Numbers<double>({3 + i});
  }
  const std::string descr =
      "[('x', '<f8'), ('Y', '<f8'), ('', '|V4'), ('v', '<f4', (2,)), ('ring', '<u2'), "
      "('z', '<f8')]";
  const PointCloud cloud = Read("a.npy", Npy(descr, "(2,)", data));
  EXPECT_THAT(cloud.x, ElementsAre(1, 4));
  EXPECT_THAT(cloud.y, ElementsAre(2, 5));
  EXPECT_THAT(cloud.z, ElementsAre(3, 6));
  EXPECT_THAT(cloud.ring, ElementsAre(0, 3));
}

TEST(Tables, NpyIsRefused) {
  const std::string six = Numbers<float>({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(MessageOn("a.npy", Npy("'<f4'", "(2, 3)", six)), "nothing was thrown");
  EXPECT_THAT(MessageOn("a.npy", "junk"), HasSubstr("a.npy: no .npy file"));
  EXPECT_THAT(MessageOn("a.npy", Npy("'<f4'", "(3, 2)", six)), HasSubstr("with 2 columns"));
  EXPECT_THAT(MessageOn("a.npy", Npy("'<f4'", "(6,)", six)), HasSubstr("of 1 dimensions"));
  EXPECT_THAT(MessageOn("a.npy", Npy("'<f4'", "(200000000, 3)", six)),
              HasSubstr("24 bytes follow the header; expected 200000000 points of 12 bytes"));
  EXPECT_THAT(MessageOn("a.npy", Npy("'<f2'", "(2, 6)", six)), HasSubstr("of type \"f2\""));
  EXPECT_THAT(MessageOn("a.npy", Npy("'<c8'", "(1, 3)", six)), HasSubstr("of type \"c8\""));
  EXPECT_THAT(MessageOn("a.npy", Npy("'|O'", "(2, 3)", six)), HasSubstr("of type \"O\""));
  EXPECT_THAT(MessageOn("a.npy", Npy("[('x', '<f4'), ('y', '>f4'), ('z', '<f4')]", "(2,)", six)),
              HasSubstr("both byte orders"));
  EXPECT_THAT(MessageOn("a.npy", Npy("{'x'", "(2, 3)", six)), HasSubstr("the header has"));
  EXPECT_THAT(MessageOn("a.npy", Npy("'<f4'", "(2, 3)", six).substr(0, 60)), HasSubstr("no .npy"));
}

}  // namespace
}  // namespace icpscape
