// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/lidar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

constexpr double kRadians = M_PI / 180;

LidarOptions Perfect() {
  LidarOptions options;
  options.range_noise_m = options.ring_bias_m = options.dropout = 0;
  return options;
}

// A bright square plate of 200 m about a point, spanned by u and v.
Mesh Plate(const Vec3& centre, const Vec3& u, const Vec3& v) {
  Mesh mesh;
  mesh.AddQuad(centre - 100 * u - 100 * v, centre + 100 * u - 100 * v, centre + 100 * u + 100 * v,
               centre - 100 * u + 100 * v, {Label::kBuilding, Material::kPlaster, 7});
  return mesh;
}

PointCloud ScanOf(Mesh mesh, const LidarOptions& options, std::uint64_t key = 1) {
  return ScanWorld(RayCaster(std::move(mesh)), nullptr, SE3d(), options, 5, key, 1);
}

TEST(Lidar, BeamsAreThoseOfTheHdl64) {
  // Data sheet: 64 lasers from +2 to -24.8 degrees.
  EXPECT_NEAR(RingElevation(0), 2 * kRadians, 0.1 * kRadians);
  EXPECT_NEAR(RingElevation(63), -24.8 * kRadians, 0.3 * kRadians);
  for (int i = 1; i < kLidarRings; ++i) {
    const double step = (RingElevation(i - 1) - RingElevation(i)) / kRadians;
    EXPECT_GT(step, 0.3) << i;
    EXPECT_LT(step, 0.6) << i;
  }
  EXPECT_EQ(LidarOptions().AzimuthSteps(), 2007);  // 360 / 0.1794.
}

TEST(Lidar, SeesLevelGroundWhereItIs) {
  const PointCloud cloud =
      ScanOf(Plate(Vec3(0, 0, -1.73), Vec3::UnitX(), Vec3::UnitY()), Perfect());
  ASSERT_GT(cloud.size(), 50000U);
  for (std::size_t i = 0; i < cloud.size(); i += 97) {
    EXPECT_NEAR(cloud.z[i], -1.73, 1e-4);
    // Similar triangles: the beam drops by height + 1.73 over the distance.
    const int ring = cloud.ring[i];
    const double expected = (RingHeight(ring) + 1.73) / std::tan(-RingElevation(ring));
    EXPECT_NEAR(std::hypot(cloud.x[i], cloud.y[i]) / expected, 1, 1e-5) << ring;
    EXPECT_EQ(SemanticOf(cloud.label[i]), Label::kBuilding);
    EXPECT_EQ(cloud.label[i] >> 16, 7);
  }
}

TEST(Lidar, SeesAWallWhereItIs) {
  const PointCloud cloud = ScanOf(Plate(Vec3(0, 10, 0), Vec3::UnitX(), Vec3::UnitZ()), Perfect());
  ASSERT_GT(cloud.size(), 10000U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_NEAR(cloud.y[i], 10, 1e-4);
  }
}

TEST(Lidar, ThePoseTurnsTheScan) {
  const SE3d T_world_lidar(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()).toRotationMatrix(),
                           Vec3(0, 4, 0));
  const RayCaster wall(Plate(Vec3(0, 10, 0), Vec3::UnitX(), Vec3::UnitZ()));
  const PointCloud cloud = ScanWorld(wall, nullptr, T_world_lidar, Perfect(), 5, 1, 1);
  ASSERT_GT(cloud.size(), 10000U);
  for (std::size_t i = 0; i < cloud.size(); i += 31) {
    EXPECT_NEAR(cloud.x[i], 6, 1e-4);
  }
}

TEST(Lidar, TheCarHidesTheGroundBeforeIt) {
  const PointCloud cloud =
      ScanOf(Plate(Vec3(0, 0, -1.73), Vec3::UnitX(), Vec3::UnitY()), Perfect());
  double nearest_ahead = 1e9;
  double nearest_abeam = 1e9;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double distance = std::hypot(cloud.x[i], cloud.y[i]);
    if (std::abs(cloud.y[i]) < 0.05 * cloud.x[i]) {
      nearest_ahead = std::min(nearest_ahead, distance);
    } else if (std::abs(cloud.x[i]) < 0.05 * cloud.y[i]) {
      nearest_abeam = std::min(nearest_abeam, distance);
    }
  }
  // On KITTI 00/15 the nearest road is 4.6 m ahead and 4.3 m to the left, on a slightly tilted car.
  EXPECT_NEAR(nearest_ahead, 4.6, 0.3);
  EXPECT_NEAR(nearest_abeam, 4.1, 0.3);
}

TEST(Lidar, NearerIsInFront) {
  Mesh far = Plate(Vec3(0, 20, 0), Vec3::UnitX(), Vec3::UnitZ());
  const RayCaster standing(far);
  const RayCaster moving(Plate(Vec3(0, 10, 0), Vec3::UnitX(), Vec3::UnitZ()));
  const PointCloud a = ScanWorld(standing, &moving, SE3d(), Perfect(), 5, 1, 1);
  const PointCloud b = ScanWorld(moving, &standing, SE3d(), Perfect(), 5, 1, 1);
  EXPECT_EQ(a.y, b.y);
  EXPECT_NEAR(*std::max_element(a.y.begin(), a.y.end()), 10, 1e-4);
}

TEST(Lidar, NoiseAndBiasHaveTheirSize) {
  const Mesh wall = Plate(Vec3(0, 10, 0), Vec3::UnitX(), Vec3::UnitZ());
  LidarOptions options = Perfect();
  options.range_noise_m = 0.05;
  const auto mean_and_deviation = [](const PointCloud& cloud) {
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vec3 origin(0, 0, RingHeight(cloud.ring[i]));
      const Vec3 ray = (cloud.Point(i) - origin).normalized();
      const double error = (cloud.Point(i) - origin).norm() - 10 / ray.y();
      sum += error;
      squares += error * error;
    }
    const double n = static_cast<double>(cloud.size());
    return std::make_pair(sum / n, std::sqrt(squares / n));
  };
  const auto [noise_mean, noise] = mean_and_deviation(ScanOf(wall, options));
  EXPECT_NEAR(noise, 0.05, 0.001);
  EXPECT_NEAR(noise_mean, 0, 0.001);
  options = Perfect();
  options.ring_bias_m = 0.05;
  const auto [bias_mean, bias] = mean_and_deviation(ScanOf(wall, options));
  EXPECT_NEAR(bias, 0.05, 0.015);  // 64 draws.
  EXPECT_NEAR(bias_mean, 0, 0.02);
  // The same sensor errs the same way in another scan.
  const PointCloud first = ScanOf(wall, options, 1);
  const PointCloud second = ScanOf(wall, options, 2);
  EXPECT_NEAR(mean_and_deviation(first).first, mean_and_deviation(second).first, 1e-3);
  EXPECT_NE(first.x, second.x);
}

TEST(Lidar, DropoutLosesItsShare) {
  const Mesh ground = Plate(Vec3(0, 0, -1.73), Vec3::UnitX(), Vec3::UnitY());
  LidarOptions options = Perfect();
  const double all = static_cast<double>(ScanOf(ground, options).size());
  options.dropout = 0.25;
  EXPECT_NEAR(static_cast<double>(ScanOf(ground, options).size()) / all, 0.75, 0.01);
}

TEST(Lidar, DarkRoadEndsNearFiftyMetres) {
  Mesh mesh;
  mesh.AddQuad(Vec3(-150, -150, -1.73), Vec3(150, -150, -1.73), Vec3(150, 150, -1.73),
               Vec3(-150, 150, -1.73), {Label::kRoad, Material::kAsphalt});
  const PointCloud cloud = ScanOf(mesh, Perfect());
  std::size_t beyond = 0;
  float farthest = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float range = std::hypot(cloud.x[i], cloud.y[i]);
    farthest = std::max(farthest, range);
    beyond += range > 60 ? 1U : 0U;
  }
  EXPECT_GT(farthest, 45);
  EXPECT_LT(static_cast<double>(beyond) / static_cast<double>(cloud.size()), 0.02);
}

TEST(Lidar, RefusesWhatNoLidarHas) {
  for (double LidarOptions::*member :
       {&LidarOptions::range_noise_m, &LidarOptions::ring_bias_m, &LidarOptions::dropout,
        &LidarOptions::azimuth_step_deg, &LidarOptions::max_range_m}) {
    for (const double value : {-1., 1e6, std::nan("")}) {
      LidarOptions options;
      options.*member = value;
      EXPECT_THROW(options.Check(), UsageError) << value;
    }
  }
  EXPECT_NO_THROW(LidarOptions().Check());
}

}  // namespace
}  // namespace icpscape
