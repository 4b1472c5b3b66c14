// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/natural_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace icpscape {
namespace {

using testing::ElementsAre;

std::vector<std::string> Sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end(), ComesBefore);
  return names;
}

TEST(NaturalOrder, ComparesDigitsAsNumbers) {
  EXPECT_THAT(Sorted({"scan_10", "scan_9", "scan_100", "scan_1"}),
              ElementsAre("scan_1", "scan_9", "scan_10", "scan_100"));
  EXPECT_THAT(Sorted({"2b", "10a", "2a"}), ElementsAre("2a", "2b", "10a"));
  // Several numbers: the first that differs decides.
  EXPECT_THAT(Sorted({"lap2_scan10", "lap10_scan1", "lap2_scan9", "lap1_scan30"}),
              ElementsAre("lap1_scan30", "lap2_scan9", "lap2_scan10", "lap10_scan1"));
  // More digits than any integer has.
  EXPECT_THAT(Sorted({"a100000000000000000000000", "a99999999999999999999999"}),
              ElementsAre("a99999999999999999999999", "a100000000000000000000000"));
}

TEST(NaturalOrder, TakesPaddingAndCaseForNothing) {
  EXPECT_THAT(Sorted({"scan_011", "scan_10", "scan_0009"}),
              ElementsAre("scan_0009", "scan_10", "scan_011"));
  EXPECT_THAT(Sorted({"Scan_10", "scan_9", "SCAN_11"}),
              ElementsAre("scan_9", "Scan_10", "SCAN_11"));
  EXPECT_THAT(Sorted({"s0", "s00a", "s0b", "S0a1"}), ElementsAre("s0", "s00a", "S0a1", "s0b"));
  // Between equals a byte decides, so that the order of a folder is always the same.
  EXPECT_THAT(Sorted({"scan_1", "scan_01", "Scan_1"}), ElementsAre("Scan_1", "scan_01", "scan_1"));
}

TEST(NaturalOrder, IsAnOrder) {
  const std::vector<std::string> names = {"",    "a",   "A",   "a1",  "a01",  "a1b", "a2", "b",
                                          "a-1", "a_1", "a10", "1",   "01",   "1a",  "_",  "a1_2",
                                          "é1",  "é2",  "0",   "000", "a1.5", "a1 b"};
  for (const std::string& a : names) {
    for (const std::string& b : names) {
      EXPECT_EQ(ComesBefore(a, b) + ComesBefore(b, a), a == b ? 0 : 1) << a << " " << b;
      for (const std::string& c : names) {
        EXPECT_TRUE(!ComesBefore(a, b) || !ComesBefore(b, c) || ComesBefore(a, c))
            << a << " " << b << " " << c;
      }
    }
  }
}

}  // namespace
}  // namespace icpscape
