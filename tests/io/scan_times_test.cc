// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/scan_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing_support::MessageOf;
using testing_support::TemporaryFolder;

void ExpectStamps(const std::vector<std::string>& names, double first, double second,
                  double third) {
  const ScanTimes times = TimesFromNames(names);
  EXPECT_TRUE(times.are_measured) << names[0];
  EXPECT_EQ(times.from, "names of the scans");
  ASSERT_EQ(times.times_s.size(), 3U);
  EXPECT_NEAR(times.times_s[0], first, 1e-6) << names[0];
  EXPECT_NEAR(times.times_s[1], second, 1e-6) << names[0];
  EXPECT_NEAR(times.times_s[2], third, 1e-6) << names[0];
}

TEST(TimesFromNames, ReadsStamps) {
  ExpectStamps({"1317384506.40", "1317384506.5", "1317384507.05"}, 1317384506.4, 1317384506.5,
               1317384507.05);
  ExpectStamps({"1403636579763555584", "1403636579813555456", "1403636580263555584"},
               1403636579.763555584, 1403636579.813555456, 1403636580.263555584);
  ExpectStamps({"lidar_1403636579763555", "lidar_1403636579863555", "lidar_1403636580363555"},
               1403636579.763555, 1403636579.863555, 1403636580.363555);
  ExpectStamps({"1403636579763", "1403636579863", "1403636580363"}, 1403636579.763, 1403636579.863,
               1403636580.363);
  ExpectStamps(
      {"cloud_1583836591_82590976", "cloud_1583836591_182590976", "cloud_1583836592_2590976"},
      1583836591.082590976, 1583836591.182590976, 1583836592.002590976);
  ExpectStamps({"1317384506", "1317384507", "1317384511"}, 1317384506, 1317384507, 1317384511);
  ExpectStamps({"0.25", "0.5", "1.25"}, 0.25, 0.5, 1.25);
}

// By hand: steps of 1, 1, 4 and of 5, 5, 20.
TEST(TimesFromNames, TakesRunningNumbersForACountOfPeriods) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"000012", "000013", "000014", "000018"},
        {"run2_scan5_a", "run2_scan10_a", "run2_scan15_a", "run2_scan35_a"}}) {
    const ScanTimes times = TimesFromNames(names);
    EXPECT_FALSE(times.are_measured);
    EXPECT_EQ(times.from, kTimesByNumber);
    EXPECT_THAT(times.times_s, ElementsAre(0, 0.1, 0.2, DoubleNear(0.6, 1e-12)));
  }
}

TEST(TimesFromNames, AreEvenWhereNamesTellNone) {
  const std::vector<std::vector<std::string>> cases = {
      {"000005", "000006", "000007", "000008"},                   // No gap.
      {"scan_10", "scan_20", "scan_30", "scan_40"},               // None either.
      {"0", "1", "2", "100"},                                     // Another drive, not ten seconds.
      {"a", "b", "c", "d"},                                       // No numbers.
      {"a1_1", "a1_2", "a2_1", "a2_5"},                           // Two of them.
      {"1", "2", "x3", "7"},                                      // Unlike names.
      {"1", "01", "2", "5"},                                      // Equal numbers.
      {"1.1", "1.10", "1.3", "1.9"},                              // Equal stamps.
      {"1317384506.40", "1317384506.5", "12", "13"},              // Stamps of two kinds.
      {"0000000000", "0000000001", "0000000002", "0000000003"}};  // Ten digits, and no stamp.
  for (const std::vector<std::string>& names : cases) {
    const ScanTimes times = TimesFromNames(names);
    EXPECT_FALSE(times.are_measured) << names[3];
    EXPECT_EQ(times.from, kNoTimes) << names[3];
    EXPECT_THAT(times.times_s, ElementsAre(0, 0.1, 0.2, 3 * 0.1)) << names[3];
  }
  EXPECT_THAT(TimesFromNames({"7"}).times_s, ElementsAre(0));
}

class TimesFile : public testing::Test {
 protected:
  std::vector<double> Read(const std::string& text, std::size_t count) const {
    return ReadTimesOfScans(folder_.Write("times.txt", text), count);
  }
  std::string Message(const std::string& text, std::size_t count) const {
    return MessageOf([&] { Read(text, count); });
  }
  TemporaryFolder folder_;
};

TEST_F(TimesFile, HasATimeForEachScan) {
  EXPECT_THAT(Read("0.5\n1\n2.5e0\n", 3), ElementsAre(0.5, 1, 2.5));
  EXPECT_THAT(
      Read("# timestamp tx ty tz qx qy qz qw\n\n1.5 0 0 0 0 0 0 1\n 2 0 0 0 0 0 0 1\r\n", 2),
      ElementsAre(1.5, 2));
  EXPECT_THAT(
      Read("1403636579763555584,a.png\n1403636580763555584,b.png\n", 2),
      ElementsAre(DoubleNear(1403636579.763555584, 1e-6), DoubleNear(1403636580.763555584, 1e-6)));
  EXPECT_THAT(Read("2011-09-26 00:00:10.5\n2011-09-26 00:00:11.25\n", 2),
              ElementsAre(26 * 86400 + 10.5, 26 * 86400 + 11.25));
}

TEST_F(TimesFile, IsRefusedWhereItHasNot) {
  EXPECT_THAT(Message("0\n1\n", 3),
              EndsWith("times.txt: 2 times; expected one for each of the 3 scans."));
  EXPECT_THAT(Message("0\n#\n1\n1\n", 3), HasSubstr("times.txt:4: \"1\"; expected a time after"));
  EXPECT_THAT(Message("0\nsoon\n", 2), HasSubstr("times.txt:2: \"soon\""));
  EXPECT_THAT(Message("0\nnan\n", 2), HasSubstr("times.txt:2: \"nan\""));
  EXPECT_THAT(MessageOf([&] { ReadTimesOfScans(folder_.path() / "none.txt", 1); }),
              HasSubstr("none.txt: cannot be read; expected the times of the scans."));
}

}  // namespace
}  // namespace icpscape
