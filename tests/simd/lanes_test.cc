// SPDX-License-Identifier: BSD-3-Clause
// Lanes at the baseline's width, which every machine has; each operation lane by lane against the
// same one on doubles. The kernels of all levels are held against one another in tests/objective.
#define ICPSCAPE_SIMD_WIDTH 4
#include "icpscape/simd/lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace icpscape {
namespace {

const double kA[kLanes] = {1.5, -2, 0, 1e300, -1e-300, 3, 0.1, -7};
const double kB[kLanes] = {0.5, 4, -3, 1e10, 2, -0.25, 0.7, 11};

void ExpectLanes(const Lanes& lanes, const std::function<double(double, double)>& expected) {
  double values[kLanes];
  lanes.StoreTo(values);
  for (int i = 0; i < kLanes; ++i) {
    EXPECT_EQ(values[i], expected(kA[i], kB[i])) << "lane " << i;
  }
}

TEST(Lanes, ComputeAsDoublesDo) {
  const Lanes a = Lanes::Load(kA), b = Lanes::Load(kB);
  ExpectLanes(a + b, [](double x, double y) { return x + y; });
  ExpectLanes(a - b, [](double x, double y) { return x - y; });
  ExpectLanes(a * b, [](double x, double y) { return x * y; });
  ExpectLanes(a / b, [](double x, double y) { return x / y; });
  ExpectLanes(-a, [](double x, double) { return -x; });
  ExpectLanes(abs(a), [](double x, double) { return std::abs(x); });
  ExpectLanes(sqrt(abs(a)), [](double x, double) { return std::sqrt(std::abs(x)); });
  ExpectLanes(RootOrZero(a), [](double x, double) { return x > 0 ? std::sqrt(x) : 0; });
  ExpectLanes(InverseOrZero(a), [](double x, double) { return x > 0 ? 1 / x : 0; });
  ExpectLanes(Lanes(2.5), [](double, double) { return 2.5; });
  Lanes c = a;
  c += b;
  c *= b;
  c -= a;
  c /= b;
  ExpectLanes(c, [](double x, double y) { return ((x + y) * y - x) / y; });
}

TEST(Lanes, LoadFloatsAndSumInOrder) {
  const float floats[kLanes] = {1, 2.5F, -3, 0.1F, 1e30F, -1e30F, 7, 1e-40F};
  double values[kLanes];
  Lanes::Load(floats).StoreTo(values);
  for (int i = 0; i < kLanes; ++i) {
    EXPECT_EQ(values[i], static_cast<double>(floats[i]));
  }
  // From left to right: 1 is lost beside 1e16, and nothing is lost behind it.
  const double order[kLanes] = {1e16, 1, -1e16, 1, 0, 0, 0, 0.5};
  EXPECT_EQ(Lanes::Load(order).Sum(), 1.5);
}

TEST(Lanes, AreNotZeroWhereAnyIsNot) {
  const double x[kLanes] = {1, 0, 0, 0, -1e-300, 0, 0, NAN};
  const double y[kLanes] = {0, 2, 0, 0, 0, -0.0, 0, 0};
  const double z[kLanes] = {0, 0, -3, 0, 0, 0, 1e-300, 0};
  const double expected[kLanes] = {1, 1, 1, 0, 1, 0, 1, 1};
  double values[kLanes];
  IsNotZero(Lanes::Load(x), Lanes::Load(y), Lanes::Load(z)).StoreTo(values);
  for (int i = 0; i < kLanes; ++i) {
    EXPECT_EQ(values[i], expected[i]) << "lane " << i;
  }
}

TEST(Lanes, CompareWhereAllAgreeAndStopWhereTheyDoNot) {
  EXPECT_TRUE(Lanes(1) < Lanes(2));
  EXPECT_FALSE(Lanes(2) < Lanes(2));
  EXPECT_TRUE(Lanes(2) <= Lanes(2));
  EXPECT_FALSE(Lanes(2) > Lanes(2));
  EXPECT_TRUE(Lanes(3) > Lanes(2));
  EXPECT_TRUE(Lanes(2) >= Lanes(2));
  EXPECT_FALSE(Lanes(1) >= Lanes(2));
  EXPECT_TRUE(Lanes(2) == Lanes(2));
  EXPECT_TRUE(Lanes(2) != Lanes(1));
  for (int odd = 0; odd < kLanes; ++odd) {
    double values[kLanes] = {1, 1, 1, 1, 1, 1, 1, 1};
    values[odd] = 3;
    const Lanes mixed = Lanes::Load(values);
    EXPECT_DEATH(static_cast<void>(mixed < Lanes(2)), "");
    EXPECT_DEATH(static_cast<void>(mixed == Lanes(3)), "");
  }
}

}  // namespace
}  // namespace icpscape
