// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/predicates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace icpscape {
namespace {

Curve Sampled(const std::function<double(double)>& f, int samples = 100) {
  CurveOptions options;
  options.samples = samples;
  Curve curve;
  for (int i = 0; i < samples; ++i) {
    CurvePoint point;
    point.u = options.U(i);
    point.rmse = f(point.u);
    curve.points.push_back(point);
  }
  return curve;
}

double Basin(double u) { return 0.2 + (u - 1) * (u - 1); }

TEST(Predicates, ArgminIsTheLeastSample) {
  EXPECT_EQ(ArgminU(Sampled(Basin)), 1);
  EXPECT_TRUE(ArgminIsNear(Sampled(Basin), 1));
  EXPECT_FALSE(ArgminIsNear(Sampled(Basin), 0));
  // The grid has no 1.1; 1.0909 counts as near, 1.1212 does not.
  EXPECT_TRUE(ArgminIsNear(Sampled([](double u) { return Basin(u - 0.0909); }), 1));
  EXPECT_FALSE(ArgminIsNear(Sampled([](double u) { return Basin(u - 0.1212); }), 1));
}

TEST(Predicates, ArgminAtTheToleranceCounts) {
  // 31 samples have 1.1 and 0.9 but for rounding.
  EXPECT_TRUE(ArgminIsNear(Sampled([](double u) { return std::abs(u - 1.1); }, 31), 1));
  EXPECT_TRUE(ArgminIsNear(Sampled([](double u) { return std::abs(u - 0.9); }, 31), 1));
}

// Samples at every thousandth.
TEST(Predicates, TolerancesAreATenthAndThreeTwentieths) {
  const auto at = [](double u_star) {
    return Sampled([=](double u) { return std::abs(u - u_star); }, 3001);
  };
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(ArgminIsNear(at(0.5 + 0.1 * side), 0.5));
    EXPECT_FALSE(ArgminIsNear(at(0.5 + 0.101 * side), 0.5));
    EXPECT_TRUE(HasLocalMinimumNear(at(0.5 + 0.15 * side), 0.5));
    EXPECT_FALSE(HasLocalMinimumNear(at(0.5 + 0.151 * side), 0.5));
  }
}

TEST(Predicates, ValueIsLinearBetweenSamples) {
  const Curve curve = Sampled([](double u) { return 3 * u; }, 4);
  EXPECT_DOUBLE_EQ(ValueAt(curve, 0.25), 0.75);
  EXPECT_DOUBLE_EQ(ValueAt(curve, -1), -3);
  EXPECT_DOUBLE_EQ(ValueAt(curve, 2), 6);
}

TEST(Predicates, MedianRemovesSingleOutliersAndKeepsSlopes) {
  Curve curve = Sampled([](double u) { return u; }, 4);
  EXPECT_THAT(MedianOfThree(curve), testing::ElementsAre(-1, 0, 1, 2));
  curve.points[2].rmse = -7;
  EXPECT_THAT(MedianOfThree(curve), testing::ElementsAre(-1, -1, 0, 2));
}

TEST(Predicates, OneBasinHasOneLocalMinimum) {
  const auto minima = LocalMinima(Sampled(Basin));
  ASSERT_EQ(minima.size(), 1U);
  EXPECT_EQ(minima[0].u, 1);
  EXPECT_EQ(minima[0].rmse, 0.2);
  EXPECT_NEAR(minima[0].depth, 1, 0.01);  // From 0.2 to 1.2 at u = 2.
}

TEST(Predicates, FallingToTheEndIsNoLocalMinimum) {
  EXPECT_TRUE(LocalMinima(Sampled([](double u) { return u; })).empty());
  EXPECT_TRUE(LocalMinima(Sampled([](double) { return 1; })).empty());
}

TEST(Predicates, TwoBasinsWithTheirDepths) {
  // Global at 1 (value 0), local at 0 (value 0.2), the crest between them at 0.5 (0.6).
  const Curve curve =
      Sampled([](double u) { return std::min(0.2 + 0.8 * std::abs(u), 1.2 * std::abs(u - 1)); });
  const auto minima = LocalMinima(curve);
  ASSERT_EQ(minima.size(), 2U);
  EXPECT_EQ(minima[0].u, 0);
  EXPECT_EQ(minima[1].u, 1);
  EXPECT_NEAR(minima[0].depth, 0.4, 0.05);
  EXPECT_NEAR(minima[1].depth, 1, 0.1);  // Out to -1.
  EXPECT_TRUE(HasLocalMinimumNear(curve, 0));
  EXPECT_TRUE(HasLocalMinimumNear(curve, 1.15));
  EXPECT_FALSE(HasLocalMinimumNear(curve, 1.2));
  EXPECT_FALSE(HasLocalMinimumNear(curve, 0.5));
}

TEST(Predicates, ADipOfOneSampleIsNoLocalMinimum) {
  Curve curve = Sampled(Basin);
  curve.points[20].rmse -= 0.5;
  EXPECT_EQ(LocalMinima(curve).size(), 1U);
}

TEST(Predicates, PlateauIsOneLocalMinimum) {
  const auto minima = LocalMinima(Sampled([](double u) { return std::max(0.5, Basin(u)); }));
  EXPECT_EQ(minima.size(), 1U);
}

TEST(Predicates, FlankSlopeIsTheMeanOfBothSides) {
  const Curve curve = Sampled([](double u) { return u < 1 ? 2 * (1 - u) : 4 * (u - 1); });
  EXPECT_NEAR(FlankSlope(curve, 1), 3, 1e-12);
  EXPECT_NEAR(FlankSlope(Sampled([](double u) { return 5 * u; }), 1), 0, 1e-12);
  // Over 0.3 to either side: 0.3^2 / 0.3.
  EXPECT_NEAR(FlankSlope(Sampled(Basin, 301), 1), 0.3, 1e-9);
}

TEST(Predicates, MonotonicDescent) {
  EXPECT_TRUE(DescendsMonotonically(Sampled(Basin), 0, 1));
  EXPECT_TRUE(DescendsMonotonically(Sampled(Basin), -1, 1));
  EXPECT_FALSE(DescendsMonotonically(Sampled(Basin), 0, 1.2));
  EXPECT_FALSE(DescendsMonotonically(Sampled(Basin), 1, 0)) << "there is no way from 1 to 0";
  Curve bump = Sampled(Basin);
  bump.points[50].rmse += 0.5;
  EXPECT_TRUE(DescendsMonotonically(bump, 0, 1)) << "one sample is smoothed away";
  bump.points[51].rmse += 0.5;
  EXPECT_FALSE(DescendsMonotonically(bump, 0, 1));
}

}  // namespace
}  // namespace icpscape
