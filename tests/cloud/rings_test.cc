// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/rings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>

#include "icpscape/common/error.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

constexpr double kDegree = M_PI / 180;

void Add(double azimuth_deg, double elevation_deg, double range_m, int ring, PointCloud* cloud,
         std::vector<int>* truth) {
  const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
  cloud->x.push_back(static_cast<float>(range_m * std::cos(e) * std::cos(a)));
  cloud->y.push_back(static_cast<float>(range_m * std::cos(e) * std::sin(a)));
  cloud->z.push_back(static_cast<float>(range_m * std::sin(e)));
  truth->push_back(ring);
}

// 64 rings of 2000 points, 70 % of them dropped, azimuths shaken by 0.3 degrees.
PointCloud SparseScan(std::vector<int>* truth) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  PointCloud cloud;
  for (int ring = 0; ring < 64; ++ring) {
    for (int k = 0; k < 2000; ++k) {
      const double azimuth = 0.18 * k + 0.6 * (uniform(random) - 0.5);
      if (uniform(random) < 0.3) {
        Add(azimuth, 2 - 0.42 * ring, 5 + 40 * uniform(random), ring, &cloud, truth);
      }
    }
  }
  return cloud;
}

TEST(Rings, AreRecoveredWithDroppedAndShakenPoints) {
  std::vector<int> truth;
  PointCloud cloud = SparseScan(&truth);
  EXPECT_EQ(RecoverRings(&cloud), 64);
  // What is shaken across the seam belongs to the neighbouring ring by its azimuth; nothing else is
  // off.
  std::size_t different = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.ring[i] != truth[i]) {
      ++different;
      const double azimuth = std::atan2(cloud.y[i], cloud.x[i]);
      EXPECT_LT(std::abs(azimuth), 0.31 * kDegree);
      EXPECT_EQ(cloud.ring[i], truth[i] + (azimuth < 0 ? -1 : 1));
    }
  }
  EXPECT_LT(different, 64U);
}

TEST(Rings, AreRecoveredFromOneQuadrant) {
  std::vector<int> truth;
  PointCloud cloud;
  for (int ring = 0; ring < 5; ++ring) {
    for (int k = 0; k < 50; ++k) {
      Add(100 + k, -2. * ring, 10, ring, &cloud, &truth);
    }
  }
  EXPECT_EQ(RecoverRings(&cloud), 5);
  EXPECT_THAT(cloud.ring, testing::ElementsAreArray(truth));
}

// A step back by more than 20 degrees begins a ring; a smaller one is noise. There are 2 to 128.
TEST(Rings, BeginWhereTheAzimuthGoesBack) {
  const auto rings = [](const std::vector<double>& azimuths_deg) {
    std::vector<int> truth;
    PointCloud cloud;
    for (const double azimuth : azimuths_deg) {
      Add(azimuth, 0, 10, 0, &cloud, &truth);
    }
    RecoverRings(&cloud);
    return cloud.ring;
  };
  EXPECT_THAT(rings({100, 150, 129, 149, 130}), testing::ElementsAre(0, 0, 1, 1, 1));
  std::vector<double> saw;
  for (int ring = 0; ring < 128; ++ring) {
    saw.insert(saw.end(), {10, 90});
  }
  EXPECT_EQ(rings(saw).back(), 127);
  saw.insert(saw.end(), {10, 90});
  EXPECT_THROW(rings(saw), InputError);
}

TEST(Rings, ThatAreThereStay) {
  PointCloud cloud;
  cloud.x = {1, 2, 3};
  cloud.y = {0, 0, 0};
  cloud.z = {0, 0, 0};
  cloud.ring = {3, 0, 5};
  EXPECT_EQ(RecoverRings(&cloud), 6);
  EXPECT_THAT(cloud.ring, testing::ElementsAre(3, 0, 5));
}

TEST(Rings, OfAnotherOrderAreRefused) {
  std::vector<int> truth;
  PointCloud one;
  for (int k = 0; k < 50; ++k) {
    Add(k, 0, 10, 0, &one, &truth);
  }
  EXPECT_THROW(RecoverRings(&one), InputError);

  PointCloud shuffled;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> azimuth(0, 360);
  for (int k = 0; k < 1000; ++k) {
    Add(azimuth(random), 0, 10, 0, &shuffled, &truth);
  }
  EXPECT_THROW(RecoverRings(&shuffled), InputError);
  EXPECT_TRUE(shuffled.ring.empty());
  EXPECT_THROW(PointsByRing(shuffled), InputError);
  PointCloud empty;
  EXPECT_EQ(RecoverRings(&empty), 0);
}

TEST(Rings, ListTheirPointsInOrder) {
  PointCloud cloud;
  cloud.x = {1, 2, 3, 4};
  cloud.y = cloud.z = {0, 0, 0, 0};
  cloud.ring = {2, 0, 2, 0};
  EXPECT_THAT(PointsByRing(cloud),
              testing::ElementsAre(testing::ElementsAre(1, 3), testing::IsEmpty(),
                                   testing::ElementsAre(0, 2)));
}

struct Scan {
  const char* sequence;
  int frame;
};

// How a test's parameter reads in its name and its output.
void PrintTo(const Scan& scan, std::ostream* out) {
  *out << "scan_" << scan.sequence << "_" << scan.frame;
}

class RealRings : public testing::TestWithParam<Scan> {};

TEST_P(RealRings, Are64FromTopToBottom) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  PointCloud cloud = KittiScan(GetParam().sequence, GetParam().frame);
  ASSERT_EQ(RecoverRings(&cloud), 64);
  std::vector<double> medians;
  for (const std::vector<std::int32_t>& ring : PointsByRing(cloud)) {
    // A turn at 0.18 degrees has 2000 points; the lowest rings lose those on the car itself.
    EXPECT_GT(ring.size(), 900U);
    EXPECT_LT(ring.size(), 2250U);
    std::vector<double> elevations;
    double squares = 0;
    std::size_t back = 0;
    double previous = -1;
    for (const std::int32_t index : ring) {
      const Vec3 p = cloud.Point(static_cast<std::size_t>(index));
      elevations.push_back(std::atan2(p.z(), std::hypot(p.x(), p.y())) / kDegree);
      const double azimuth = std::fmod(std::atan2(p.y(), p.x()) / kDegree + 360, 360);
      back += azimuth < previous - 0.5 ? 1 : 0;
      previous = azimuth;
    }
    const auto middle = elevations.begin() + static_cast<std::ptrdiff_t>(elevations.size() / 2);
    std::nth_element(elevations.begin(), middle, elevations.end());
    for (const double elevation : elevations) {
      squares += (elevation - *middle) * (elevation - *middle);
    }
    // The lasers lie 0.33 to 0.5 degrees apart, of 26.8 degrees in all.
    EXPECT_LT(std::sqrt(squares / static_cast<double>(elevations.size())), 0.8);
    EXPECT_LT(back, ring.size() / 100);
    medians.push_back(*middle);
  }
  EXPECT_TRUE(std::is_sorted(medians.rbegin(), medians.rend()));
  EXPECT_NEAR(medians.front(), 2.5, 0.5);
  EXPECT_NEAR(medians.back(), -23.6, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Kitti, RealRings,
                         testing::Values(Scan{"00", 0}, Scan{"00", 14}, Scan{"00", 15},
                                         Scan{"00", 94}, Scan{"00", 95}, Scan{"07", 0},
                                         Scan{"07", 4}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace icpscape
