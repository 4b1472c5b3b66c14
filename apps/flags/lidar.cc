// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/lidar.h"

#include <gflags/gflags.h>

#include "apps/run/flag.h"

static const icpscape::FlagGroup group(__FILE__, "Simulated lidar");

DEFINE_int32(seed, 1,
             "Seed of all that is random: the simulated world and its lidar, and random starts.");
static const icpscape::FlagMark seed_mark(&FLAGS_seed, icpscape::kShown);
DEFINE_double(azimuth_step_deg, icpscape::LidarOptions().azimuth_step_deg,
              "Angle between two firings (degrees); KITTI's HDL-64E by default.");
DEFINE_double(range_noise_m, icpscape::LidarOptions().range_noise_m,
              "Standard deviation of a range between firings of one laser (m); "
              "measured on KITTI.");
DEFINE_double(ring_bias_m, icpscape::LidarOptions().ring_bias_m,
              "Standard deviation of the lasers' constant range errors (m); the "
              "HDL-64E's data sheet and KITTI agree.");
DEFINE_double(dropout, icpscape::LidarOptions().dropout,
              "Share of returns lost at random; measured on KITTI.");
DEFINE_bool(
    skewed, false,
    "The lidar and all that moves go on while it turns, as real ones do, and points have times; "
    "else a scan is a snapshot.");

namespace icpscape {

LidarOptions LidarFromFlags() {
  LidarOptions options;
  options.azimuth_step_deg = FLAGS_azimuth_step_deg;
  options.range_noise_m = FLAGS_range_noise_m;
  options.ring_bias_m = FLAGS_ring_bias_m;
  options.dropout = FLAGS_dropout;
  options.skewed = FLAGS_skewed;
  options.Check();
  return options;
}

std::uint64_t SeedFromFlags() {
  RequireFlag(FLAGS_seed >= 0, "seed", std::to_string(FLAGS_seed), "0 or more");
  return static_cast<std::uint64_t>(FLAGS_seed);
}

std::string LidarText() {
  std::string text;
  for (const Flag& flag : OwnFlags()) {
    if (flag.file == __FILE__) {
      text += (text.empty() ? "" : "; ") + flag.name + " " + flag.value;
    }
  }
  return text;
}

}  // namespace icpscape
