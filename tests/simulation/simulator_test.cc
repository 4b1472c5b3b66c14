// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace icpscape {
namespace {

// Level ground: all beams of a ring are equally long, up to the laser's constant error.
World Ground() {
  World world;
  const Vec3 x = 100 * Vec3::UnitX();
  const Vec3 y = 100 * Vec3::UnitY();
  world.standing.AddQuad(-x - y, x - y, x + y, y - x, {Label::kBuilding, Material::kPlaster, 7});
  return world;
}

// The mean range of every ring (m); NaN for rings without points.
std::vector<double> RingRanges(const PointCloud& cloud) {
  std::vector<double> sum(kLidarRings, 0);
  std::vector<double> count(kLidarRings, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto ring = static_cast<std::size_t>(cloud.ring[i]);
    sum[ring] += (cloud.Point(i) - Vec3(0, 0, RingHeight(cloud.ring[i]))).norm();
    count[ring] += 1;
  }
  for (std::size_t ring = 0; ring < sum.size(); ++ring) {
    sum[ring] /= count[ring];
  }
  return sum;
}

TEST(Simulator, ASensorKeepsItsErrorsAndAnotherHasOthers) {
  LidarOptions options;
  options.range_noise_m = 0;
  options.ring_bias_m = 0.05;
  options.azimuth_step_deg = 2;
  const Simulator simulator(Ground(), options, 1);
  const SE3d T(Mat3::Identity(), Vec3(0, 0, kLidarHeightM));
  const std::vector<double> first = RingRanges(simulator.Scan(T, 0, 1, 1));
  const std::vector<double> again = RingRanges(simulator.Scan(T, 0, 2, 1));
  const std::vector<double> other = RingRanges(simulator.Scan(T, 0, 1, 1, 3));
  double sum_squared = 0;
  int rings = 0;
  for (std::size_t ring = 0; ring < first.size(); ++ring) {
    if (std::isfinite(first[ring]) && std::isfinite(other[ring])) {
      EXPECT_NEAR(first[ring], again[ring], 1e-4) << ring;
      sum_squared += std::pow(first[ring] - other[ring], 2);
      ++rings;
    }
  }
  ASSERT_GT(rings, 40);
  // The difference of two independent errors.
  EXPECT_NEAR(std::sqrt(sum_squared / rings), 0.05 * std::sqrt(2.0), 0.025);
}

}  // namespace
}  // namespace icpscape
