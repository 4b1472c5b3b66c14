// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/lidar.h"

#include <gflags/gflags.h>

#include "src/common/error.h"

DEFINE_int32(seed, 1,
             "Seed of all that is random: the simulated world and its lidar, and random starts.");
DEFINE_double(azimuth_step_deg, icpscape::LidarOptions().azimuth_step_deg,
              "Simulated lidar: angle between two firings (degrees); KITTI's HDL-64E by default.");
DEFINE_double(range_noise_m, icpscape::LidarOptions().range_noise_m,
              "Simulated lidar: standard deviation of a range between firings of one laser (m); "
              "measured on KITTI.");
DEFINE_double(ring_bias_m, icpscape::LidarOptions().ring_bias_m,
              "Simulated lidar: standard deviation of the lasers' constant range errors (m); the "
              "HDL-64E's data sheet and KITTI agree.");
DEFINE_double(dropout, icpscape::LidarOptions().dropout,
              "Simulated lidar: share of returns lost at random; measured on KITTI.");

namespace icpscape {

LidarOptions LidarFromFlags() {
  LidarOptions options;
  options.azimuth_step_deg = FLAGS_azimuth_step_deg;
  options.range_noise_m = FLAGS_range_noise_m;
  options.ring_bias_m = FLAGS_ring_bias_m;
  options.dropout = FLAGS_dropout;
  options.Check();
  return options;
}

std::uint64_t SeedFromFlags() {
  if (FLAGS_seed < 0) {
    throw UsageError("--seed=" + std::to_string(FLAGS_seed) + ": expected 0 or more.");
  }
  return static_cast<std::uint64_t>(FLAGS_seed);
}

}  // namespace icpscape
