// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/starts.h"

#include <gflags/gflags.h>

#include <cmath>

#include "apps/flags/lidar.h"
#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Random starts");

DEFINE_double(start_m, 0.5, "Longest translation of a random start from the true pose (m).");
DEFINE_double(start_deg, 3, "Largest rotation of a random start from the true pose (degrees).");

namespace icpscape {

RandomStartOptions StartsFromFlags() {
  RequireFlag(FLAGS_start_m >= 0 && FLAGS_start_m <= 1000, "start_m", Number(FLAGS_start_m),
              "0 to 1000 m");
  RequireFlag(FLAGS_start_deg >= 0 && FLAGS_start_deg < 180, "start_deg", Number(FLAGS_start_deg),
              "0 to less than 180 degrees");
  RandomStartOptions options;
  options.translation_m = FLAGS_start_m;
  options.rotation_rad = FLAGS_start_deg * M_PI / 180;
  options.seed = static_cast<unsigned>(SeedFromFlags());
  return options;
}

}  // namespace icpscape
