// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/lidar.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/simulation/random.h"

namespace icpscape {
namespace {

constexpr double kRadians = M_PI / 180;

// Reflectivity and range of the data sheet: 0.80 is seen to 120 m, 0.10 to 50 m. The power law
// through both has this exponent (an ideal diffuse target would have 1/2).
constexpr double kReferenceReflectivity = 0.80;
const double kRangeExponent = std::log(120. / 50.) / std::log(0.80 / 0.10);
// Spread of the returned power between neighbouring spots of one surface (texture, speckle).
constexpr double kPowerSpread = 0.3;
const double kSpecularCosine = std::cos(8 * kRadians);

// Last ring with returns, by |azimuth| in steps of 5 degrees: measured on 57 KITTI scans of four
// drives, the two sides of the car taken together (tools/measure_lidar.py).
constexpr std::array<int, 36> kLastRing = {56, 56, 57, 60, 63, 63, 61, 60, 63, 63, 63, 63,
                                           63, 63, 63, 63, 63, 63, 63, 63, 63, 63, 63, 63,
                                           63, 62, 60, 61, 63, 62, 60, 55, 50, 52, 51, 51};

// Reflectivity that the receiver sees, speckle included.
double EffectiveReflectivity(const RayHit& hit, Random* random) {
  const Reflection reflection = ReflectionOf(hit.surface.material);
  double value = reflection.diffuse * (reflection.rough ? 1 : hit.cos_incidence);
  if (hit.cos_incidence > kSpecularCosine) {
    value += reflection.specular;
  }
  return value * std::exp(kPowerSpread * random->Normal());
}

struct Ring {
  std::vector<float> x, y, z, intensity, time_s;
  std::vector<std::int32_t> label;
};

}  // namespace

void LidarOptions::Check() const {
  const auto require = [](bool good, const char* name, double value, const char* expected) {
    if (!good) {
      throw UsageError(std::string(name) + "=" + Number(value) + ": expected " + expected + ".");
    }
  };
  require(azimuth_step_deg >= 0.01 && azimuth_step_deg <= 10, "azimuth_step_deg", azimuth_step_deg,
          "0.01 to 10 degrees");
  require(range_noise_m >= 0 && range_noise_m <= 1, "range_noise_m", range_noise_m, "0 to 1 m");
  require(ring_bias_m >= 0 && ring_bias_m <= 1, "ring_bias_m", ring_bias_m, "0 to 1 m");
  require(dropout >= 0 && dropout <= 0.9, "dropout", dropout, "0 to 0.9");
  require(max_range_m > min_range_m && max_range_m <= 1000, "max_range_m", max_range_m,
          "more than the least range, and at most 1000 m");
}

int LidarOptions::AzimuthSteps() const {
  return static_cast<int>(std::lround(360 / azimuth_step_deg));
}

// Elevations and heights are fits to KITTI 07/000000, where the car stands: per ring,
// z / rho = tan(elevation) + height / rho, residuals 0.001 to 0.004 degrees
// (tools/measure_lidar.py).
double RingElevation(int ring) {
  return kRadians * (ring < 32 ? 1.94 - 0.3435 * ring : -9.03 - 0.515 * (ring - 32));
}

double RingHeight(int ring) { return ring < 32 ? 0.206 - 0.00026 * ring : 0.135 - 0.0003 * ring; }

int LastRingPastCar(double azimuth_rad) {
  const double degrees = std::abs(std::remainder(azimuth_rad, 2 * M_PI)) / kRadians;
  return kLastRing[std::min<std::size_t>(static_cast<std::size_t>(degrees / 5), 35)];
}

PointCloud ScanWorld(const RayCaster& standing, const RayCaster* moving, const LidarMotion& motion,
                     const LidarOptions& options, std::uint64_t sensor_key, std::uint64_t key,
                     int threads) {
  const int steps = options.AzimuthSteps();
  std::array<Ring, kLidarRings> rings;
  const auto scan_ring = [&](int ring_index) {
    Ring& ring = rings[static_cast<std::size_t>(ring_index)];
    Random laser(MixKeys(sensor_key, ring_index));
    const double bias = options.ring_bias_m * laser.Normal();
    // Firings and turns are not synchronised: each scan begins somewhere within a step.
    const double phase = laser.Uniform() + Random(key).Uniform();
    const double elevation = RingElevation(ring_index);
    const double height = RingHeight(ring_index);
    for (int j = 0; j < steps; ++j) {
      const double azimuth = (j + phase - std::floor(phase)) * 2 * M_PI / steps;
      if (ring_index > LastRingPastCar(azimuth)) {
        continue;
      }
      const Vec3 ray(std::cos(elevation) * std::cos(azimuth),
                     std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double time_s = options.skewed ? LidarMotion::TimeOf(azimuth) : 0;
      const SE3d T_world_lidar = options.skewed ? motion.At(time_s) : motion.T_world_lidar;
      const Vec3 origin = T_world_lidar * Vec3(0, 0, height);
      const Vec3 direction = T_world_lidar.R() * ray;
      RayHit hit;
      bool found = standing.Cast(origin, direction, options.max_range_m, &hit);
      if (moving != nullptr) {
        found |= moving->Cast(origin, direction, found ? hit.range_m : options.max_range_m, &hit,
                              time_s / kScanPeriodS + 0.5);
      }
      if (!found) {
        continue;
      }
      Random random(MixKeys(key, ring_index, j));
      const bool lost = random.Chance(options.dropout);
      const double reflectivity = EffectiveReflectivity(hit, &random);
      const double range = hit.range_m + bias + options.range_noise_m * random.Normal();
      const double visible_to =
          options.max_range_m *
          std::min(1., std::pow(reflectivity / kReferenceReflectivity, kRangeExponent));
      if (lost || range > visible_to || range < options.min_range_m) {
        continue;
      }
      const Vec3 p = Vec3(0, 0, height) + range * ray;
      ring.x.push_back(static_cast<float>(p.x()));
      ring.y.push_back(static_cast<float>(p.y()));
      ring.z.push_back(static_cast<float>(p.z()));
      // KITTI's intensities are hundredths.
      ring.intensity.push_back(
          static_cast<float>(std::round(100 * std::min(0.99, reflectivity)) / 100));
      ring.label.push_back(hit.surface.PointLabel());
      if (options.skewed) {
        ring.time_s.push_back(static_cast<float>(time_s));
      }
    }
  };
  // Not ParallelFor: Embree holds oneTBB to one thread here.
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < kLidarRings; i = next++) {
      scan_ring(i);
    }
  };
  std::vector<std::thread> helpers;
  for (int i = 1; i < std::min(threads, kLidarRings); ++i) {
    helpers.emplace_back(work);
  }
  work();
  for (std::thread& helper : helpers) {
    helper.join();
  }

  PointCloud cloud;
  const auto append = [](const auto& from, auto* to) {
    to->insert(to->end(), from.begin(), from.end());
  };
  for (int i = 0; i < kLidarRings; ++i) {
    const Ring& ring = rings[static_cast<std::size_t>(i)];
    append(ring.x, &cloud.x);
    append(ring.y, &cloud.y);
    append(ring.z, &cloud.z);
    append(ring.intensity, &cloud.intensity);
    append(ring.label, &cloud.label);
    append(ring.time_s, &cloud.time_s);
    cloud.ring.resize(cloud.size(), i);
  }
  return cloud;
}

}  // namespace icpscape
