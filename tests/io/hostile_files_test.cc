// SPDX-License-Identifier: BSD-3-Clause
// Files that lie about themselves: one sentence each, at once, and without the memory they ask for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "icpscape/common/error.h"
#include "icpscape/io/point_files.h"
#include "tests/support/message_of.h"
#include "tests/support/point_file_writer.h"
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

const std::vector<TestField> kXyz = {{"x"}, {"y"}, {"z"}};

double ValueOf(const TestField&, int i, int) { return 1 + i; }

std::string MessageOfReading(const TemporaryFolder& folder, const std::string& name,
                             const std::string& text) {
  return MessageOf<InputError>([&] {
    DroppedPoints dropped;
    ReadPointFile(folder.Write(name, text), &dropped);
  });
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(HostileFiles, PcdText) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& rows, int points = 2) {
    return MessageOfReading(folder, "a.pcd", PcdHeader(kXyz, points, "ascii") + rows);
  };
  // The header has eleven lines.
  EXPECT_THAT(message("1,5 2 3\n4 5 6\n"), HasSubstr("a.pcd:12: \"1,5\"; expected a number."));
  EXPECT_THAT(message("1 2 3\n1abc 2 3\n"), HasSubstr("a.pcd:13: \"1abc\"; expected a number."));
  EXPECT_THAT(message("1 2 3\nfoo bar baz\n"), HasSubstr("a.pcd:13: \"foo\""));
  EXPECT_THAT(message("1 2 3\n\n4 5\n6 7 8\n"), HasSubstr("a.pcd:14: a line of 2 numbers"));
  EXPECT_THAT(message("1 2 3 4\n5 6 7 8\n"), HasSubstr("a.pcd:12: 4 numbers; expected 3."));
  EXPECT_THAT(message("1 2 3\n4 5 6\n7 8 9\n"), HasSubstr("a.pcd:14: \"7\" after the last record"));
  EXPECT_THAT(message("1.00000000 2 3\n"), HasSubstr("ends after 1 of 2 records"));
  EXPECT_THAT(message("0x10 2 3\n4 5 6\n"), HasSubstr("\"0x10\""));
  EXPECT_THAT(message("+-1 2 3\n4 5 6\n"), HasSubstr("\"+-1\""));
  // Lines of a header are none behind DATA.
  EXPECT_THAT(message("POINTS 100000000\n1 2 3\n"), HasSubstr("a.pcd:12: \"POINTS\""));
  EXPECT_THAT(message("1 2 3\n", 1000000000), HasSubstr("1000000000 records do not fit"));
  const std::vector<TestField> many = {{"x"}, {"y"}, {"z"}, {"h", 'F', 8, 1000000}};
  EXPECT_THAT(MessageOfReading(folder, "a.pcd", PcdHeader(many, 900, "ascii") + "1 2 3 4\n"),
              HasSubstr("900 records do not fit into the 8 bytes"));
}

TEST(HostileFiles, PcdBinary) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    return MessageOfReading(folder, "a.pcd", text);
  };
  const std::string binary = PcdFile(kXyz, 20, ValueOf, "binary");
  EXPECT_THAT(message(binary.substr(0, binary.size() - 1)),
              HasSubstr("239 bytes follow the header; expected 20 points of 12 bytes"));
  EXPECT_THAT(message(binary + "x"), HasSubstr("241 bytes follow"));
  EXPECT_THAT(message(PcdHeader(kXyz, 1000000000, "binary") + "123"), HasSubstr("3 bytes follow"));
  const std::string wide =
      Replaced(PcdHeader(kXyz, 1, "binary"), "COUNT 1 1 1", "COUNT 1000000000000 1 1000000000000");
  EXPECT_THAT(message(wide + "123"), HasSubstr("3 bytes follow the header; expected 1 points of"));
  const std::string compressed = PcdFile(kXyz, 20, ValueOf, "binary_compressed");
  const std::size_t begin = compressed.find("DATA binary_compressed\n") + 23;
  const auto with_sizes = [&](double packed, double whole) {
    std::string sizes;
    testing_support::AppendAs<std::uint32_t>(packed, false, &sizes);
    testing_support::AppendAs<std::uint32_t>(whole, false, &sizes);
    return std::string(compressed).replace(begin, 8, sizes);
  };
  const double packed = static_cast<double>(compressed.size() - begin - 8);
  EXPECT_EQ(message(with_sizes(packed, 240)), "nothing was thrown");
  EXPECT_THAT(message(with_sizes(packed, 16)), HasSubstr("a whole one for 240"));
  EXPECT_THAT(message(with_sizes(packed + 1, 240)), HasSubstr("a compressed block of"));
  EXPECT_THAT(message(with_sizes(1, 240)), HasSubstr("a compressed block of 1 bytes"));
  EXPECT_THAT(message(with_sizes(packed - 5, 240)), HasSubstr("the compressed block is damaged"));
  EXPECT_THAT(message(compressed.substr(0, begin + 5)), HasSubstr("in 5 bytes"));
  EXPECT_THAT(message(Replaced(Replaced(compressed, "WIDTH 20", "WIDTH 4000000000"), "POINTS 20",
                               "POINTS 4000000000")),
              HasSubstr("expected a whole one for 48000000000"));
}

TEST(HostileFiles, PcdHeaders) {
  const TemporaryFolder folder;
  const std::string good = PcdHeader(kXyz, 1, "ascii") + "1 2 3\n";
  EXPECT_EQ(MessageOfReading(folder, "a.pcd", good), "nothing was thrown");
  const std::vector<std::array<std::string, 3>> changes = {
      {"HEIGHT 1", "HEIGHT 1\nMYKEY 1", "a.pcd:9: \"MYKEY\""},
      {"HEIGHT 1", "HEIGHT 1\nHEIGHT 1", "a.pcd:9: \"HEIGHT\""},
      {"HEIGHT 1", "HEIGHT 2", "expected POINTS to be their product"},
      {"HEIGHT 1\n", "", "no line HEIGHT"},
      {"WIDTH 1", "WIDTH 0", "expected a count above 0"},
      {"WIDTH 1", "WIDTH -1", "WIDTH \"-1\""},
      {"COUNT 1 1 1", "COUNT 1 1 -1", "COUNT \"-1\""},
      {"COUNT 1 1 1", "COUNT 1 1", "COUNT has 2 words"},
      {"SIZE 4 4 4", "SIZE 4 4", "SIZE has 2 words; expected SIZE with 3"},
      {"SIZE 4 4 4", "SIZE 4 4 3", "TYPE \"F\" of SIZE \"3\""},
      {"TYPE F F F", "TYPE F F Q", "TYPE \"Q\" of SIZE \"4\""},
      {"FIELDS x y z\n", "", "no line FIELDS"},
      {"VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 0", "VIEWPOINT has 2 words"},
      {"VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 nan 0 1 0 0 0", "VIEWPOINT has \"nan\""},
      {"DATA ascii", "DATA asci", "DATA \"asci\""},
      {"DATA ascii\n1 2 3\n", "", "no line DATA"}};
  for (const auto& [from, to, says] : changes) {
    EXPECT_THAT(MessageOfReading(folder, "a.pcd", Replaced(good, from, to)), HasSubstr(says)) << to;
  }
  EXPECT_THAT(MessageOfReading(folder, "a.pcd", "junk\x01"), HasSubstr("a.pcd:1: \"junk?\""));
  EXPECT_THAT(MessageOfReading(folder, "a.pcd", ""), HasSubstr("a whole PCD file"));
}

TEST(HostileFiles, Ply) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    return MessageOfReading(folder, "a.ply", text);
  };
  const std::string good = PlyFile(kXyz, 2, ValueOf, "ascii");
  EXPECT_EQ(message(good), "nothing was thrown");
  const std::vector<std::array<std::string, 3>> changes = {
      {"ply", "plx", "no PLY file"},
      {"format ascii 1.0", "format asci 1.0", "format \"asci\""},
      {"format ascii 1.0\n", "", "format \"\""},
      {"element vertex 2", "element vertex 1000000000", "do not fit into the"},
      {"element vertex 2", "element vertex -2", "a.ply:4: \"-2\""},
      {"element vertex 2", "element vertices 2", "0 elements \"vertex\""},
      {"property float x", "property half x", "a.ply:5: \"half\""},
      {"property float x", "property list float float x", "a length of 8, 16 or 32 bits"},
      {"property float x", "property list uchar float x", "a.ply:9: "},
      {"property float x", "proprty float x", "a.ply:5: \"proprty\""},
      {"element vertex 2\n", "", "a.ply:4: \"property\""},
      {"end_header\n1 1 1", "end_header\n1 1 1,5", "a.ply:9: \"1,5\""},
      {"end_header\n1 1 1", "end_header\n1 1", "a.ply:9: a line of 2 numbers"},
      {"2 2 2", "2 2 2\n3", "a.ply:11: \"3\" after the last"},
      {"end_header", "end", "a.ply:8: \"end\""}};
  for (const auto& [from, to, says] : changes) {
    EXPECT_THAT(message(Replaced(good, from, to)), HasSubstr(says)) << to;
  }
  for (const char* format : {"binary_little_endian", "binary_big_endian"}) {
    const std::string binary = PlyFile(kXyz, 30, ValueOf, format);
    EXPECT_THAT(message(binary.substr(0, binary.size() - 1)),
                HasSubstr("ends within record 29 of 30"));
    EXPECT_THAT(message(binary + "1"), HasSubstr("1 bytes after the last record"));
    EXPECT_THAT(message(Replaced(binary, "vertex 30", "vertex 900000000000")),
                HasSubstr("of 900000000000; expected a whole file"));
    EXPECT_THAT(
        message(Replaced(binary, "vertex 30\n",
                         "none 900000000000\nelement vertex 30\nproperty list uint float l\n")),
        HasSubstr("ends within record"));
  }
}

// No file, however damaged, crashes the reader.
TEST(HostileFiles, DamagedFilesEndInASentenceOrACloud) {
  const TemporaryFolder folder;
  std::mt19937 engine(1);
  const std::vector<TestField> fields = {
      {"x", 'F', 8}, {"_", 'U', 1, 3}, {"y"}, {"z"}, {"ring", 'U', 2}};
  const std::vector<TestField> lists = {{"x"}, {"l", 'U', 1, 3, true}, {"y"}, {"z"}};
  int clouds = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const char* formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const char* datas[] = {"ascii", "binary", "binary_compressed"};
    const bool ply = trial % 2 == 0;
    std::string file = ply ? PlyFile(lists, 10, ValueOf, formats[trial % 3])
                           : PcdFile(fields, 10, ValueOf, datas[trial % 3]);
    for (int change = 0; change < 1 + trial % 4; ++change) {
      file[engine() % file.size()] = static_cast<char>(engine());
    }
    if (trial % 5 == 0) {
      file.resize(engine() % file.size());
    }
    try {
      DroppedPoints dropped;
      ReadPointFile(folder.Write(ply ? "a.ply" : "a.pcd", file), &dropped);
      ++clouds;
    } catch (const InputError&) {
      continue;
    }
  }
  EXPECT_GT(clouds, 100);
  EXPECT_LT(clouds, 2500);
}

}  // namespace
}  // namespace icpscape
