// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/smoothness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "icpscape/cloud/rings.h"
#include "icpscape/common/error.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

PointCloud OneRing(const std::vector<Vec3>& points) {
  PointCloud cloud;
  for (const Vec3& p : points) {
    cloud.x.push_back(static_cast<float>(p.x()));
    cloud.y.push_back(static_cast<float>(p.y()));
    cloud.z.push_back(static_cast<float>(p.z()));
    cloud.ring.push_back(0);
  }
  return cloud;
}

// Eleven points, 0.25 m apart, round a right-angled corner at (8, 0, 0).
PointCloud Corner() {
  std::vector<Vec3> points;
  for (int k = -5; k <= 5; ++k) {
    points.emplace_back(k < 0 ? 8 : 8 - 0.25 * k, k < 0 ? 0.25 * k : 0, 0);
  }
  return OneRing(points);
}

SmoothnessOptions With(SmoothnessFormula formula) {
  SmoothnessOptions options;
  options.formula = formula;
  return options;
}

TEST(Smoothness, HasTheHandComputedValuesAtACorner) {
  // sum (p - p_j) over the ten others: 0.25 (1 + ... + 5) = 3.75 along x and along y.
  const PointCloud cloud = Corner();
  const auto at_corner = [&](SmoothnessFormula formula) {
    return ComputeSmoothness(cloud, With(formula), 1)[5];
  };
  EXPECT_NEAR(at_corner(SmoothnessFormula::kPrinted), 3.75 * std::sqrt(2.) / (10 * 8), 1e-15);
  EXPECT_NEAR(at_corner(SmoothnessFormula::kALoam), 2 * 3.75 * 3.75, 1e-12);
  // Ranges: along x 8 - 0.25 k; along y sqrt(64 + k^2/16).
  double sum = 3.75;
  for (int k = 1; k <= 5; ++k) {
    sum += 8 - std::sqrt(64 + k * k / 16.);
  }
  EXPECT_NEAR(at_corner(SmoothnessFormula::kLioSam), sum * sum, 1e-12);
}

TEST(Smoothness, IsZeroOnAStraightEvenLineAndHasNoValueAtItsEnds) {
  std::vector<Vec3> points;
  for (int k = 0; k < 20; ++k) {
    points.emplace_back(4, -2 + 0.25 * k, 0.5);
  }
  const std::vector<double> s =
      ComputeSmoothness(OneRing(points), With(SmoothnessFormula::kPrinted), 1);
  for (int k = 0; k < 20; ++k) {
    if (k < 5 || k >= 15) {
      EXPECT_TRUE(std::isnan(s[static_cast<std::size_t>(k)])) << k;
    } else {
      EXPECT_EQ(s[static_cast<std::size_t>(k)], 0) << k;
    }
  }
}

TEST(Smoothness, PrintedFormHasNoUnitAndALoamsGrowsWithSquaredRange) {
  const PointCloud near = Corner();
  PointCloud far = near;
  for (std::vector<float>* array : {&far.x, &far.y, &far.z}) {
    for (float& value : *array) {
      value *= 4;
    }
  }
  for (const auto& [formula, factor] :
       {std::pair{SmoothnessFormula::kPrinted, 1.}, std::pair{SmoothnessFormula::kALoam, 16.},
        std::pair{SmoothnessFormula::kLioSam, 16.}}) {
    EXPECT_NEAR(ComputeSmoothness(far, With(formula), 1)[5],
                factor * ComputeSmoothness(near, With(formula), 1)[5], 1e-12);
  }
}

TEST(Smoothness, FindsNeighborsInSpace) {
  // From (5, 0, 0) the two nearest others lie at -0.5 m and +1 m, within 1.5 m also the third.
  const PointCloud cloud =
      OneRing({{5, 0, 0}, {5, -0.5, 0}, {5, 1, 0}, {6.25, 0, 0}, {50, 0, 0}, {5, 40, 0}});
  SmoothnessOptions options;
  options.neighborhood = SmoothnessNeighborhood::kKNearest;
  options.num_neighbors = 2;
  EXPECT_NEAR(ComputeSmoothness(cloud, options, 1)[0], 0.5 / (2 * 5), 1e-15);
  options.neighborhood = SmoothnessNeighborhood::kRadius;
  options.radius_m = 1.5;
  const std::vector<double> s = ComputeSmoothness(cloud, options, 1);
  EXPECT_NEAR(s[0], std::hypot(0.5, 1.25) / (3 * 5), 1e-15);
  EXPECT_TRUE(std::isnan(s[4]));
  options.neighborhood = SmoothnessNeighborhood::kKNearest;
  options.num_neighbors = 6;
  EXPECT_TRUE(std::isnan(ComputeSmoothness(cloud, options, 1)[0]));
}

TEST(Smoothness, CountsCopiesOfAPointAsOthers) {
  const PointCloud cloud = OneRing({{5, 0, 0}, {5, 0, 0}, {5, 0, 0}, {5, 0, 0}, {5, 1, 0}});
  SmoothnessOptions options;
  options.neighborhood = SmoothnessNeighborhood::kKNearest;
  options.num_neighbors = 2;
  EXPECT_THAT(ComputeSmoothness(cloud, options, 1),
              testing::ElementsAre(0, 0, 0, 0, 2 / (2 * std::sqrt(26.))));
}

TEST(Smoothness, RefusesWhatCannotBe) {
  PointCloud cloud = Corner();
  SmoothnessOptions options;
  options.ring_points_per_side = 0;
  EXPECT_THROW(ComputeSmoothness(cloud, options, 1), UsageError);
  options = {};
  options.num_neighbors = 0;
  EXPECT_THROW(ComputeSmoothness(cloud, options, 1), UsageError);
  options = {};
  options.radius_m = std::nan("");
  EXPECT_THROW(ComputeSmoothness(cloud, options, 1), UsageError);
  cloud.ring.clear();
  EXPECT_THROW(ComputeSmoothness(cloud, {}, 1), InputError);
}

TEST(Smoothness, DoesNotDependOnThreads) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-20, 20);
  std::vector<Vec3> points;
  for (int k = 0; k < 5000; ++k) {
    points.emplace_back(uniform(random), uniform(random), uniform(random) / 10);
  }
  PointCloud cloud = OneRing(points);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.ring[i] = static_cast<std::int32_t>(i % 7);
  }
  for (const auto neighborhood : {SmoothnessNeighborhood::kRing, SmoothnessNeighborhood::kKNearest,
                                  SmoothnessNeighborhood::kRadius}) {
    SmoothnessOptions options;
    options.neighborhood = neighborhood;
    const std::vector<double> one = ComputeSmoothness(cloud, options, 1);
    const std::vector<double> three = ComputeSmoothness(cloud, options, 3);
    EXPECT_EQ(std::memcmp(one.data(), three.data(), one.size() * sizeof(double)), 0);
  }
}

}  // namespace
}  // namespace icpscape
