// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/matching.h"

#include <gflags/gflags.h>

#include <cmath>

#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Pairs: matching and rejection");

DEFINE_double(max_distance_m, 0, "Longest distance of a pair (m); 0 is no limit, as in the paper.");
DEFINE_bool(reciprocal, false,
            "Only pairs whose q has p as its own closest point (paper sec. 2.5).");
DEFINE_double(reciprocal_epsilon_m, 0,
              "With --reciprocal: how far q's closest point may be from p (m); 0 is strict "
              "(paper sec. 2.5 gives no value; Pajdla & Van Gool 1995).");
DEFINE_double(max_normal_angle_deg, 0,
              "Largest angle between a pair's normals (degrees); 0 is no limit.");
DEFINE_double(max_median_factor, 0,
              "Longest pair as a multiple of the median pair; 0 is no limit.");
DEFINE_double(kept_fraction, 1, "Fraction of the pairs to keep, the closest (trimmed ICP).");
DEFINE_double(region_size_m, 0,
              "If positive: drop cubic regions of this size (m) whose mean distance stands out "
              "(after Bengtsson & Baerveldt 1999).");
DEFINE_double(region_median_factor, 2,
              "With --region_size_m: multiple of the median region's mean.");

namespace icpscape {

MatchingOptions MatchingFromFlags() {
  MatchingOptions options;
  options.max_distance_m = RequireAtLeastZero("max_distance_m", FLAGS_max_distance_m);
  RequireAtLeastZero("reciprocal_epsilon_m", FLAGS_reciprocal_epsilon_m);
  if (FLAGS_reciprocal) {
    options.reciprocal_epsilon_m = FLAGS_reciprocal_epsilon_m;
  }
  options.max_normal_angle_rad =
      RequireAtLeastZero("max_normal_angle_deg", FLAGS_max_normal_angle_deg) * M_PI / 180;
  RequireFlag(FLAGS_max_normal_angle_deg <= 180, "max_normal_angle_deg",
              Number(FLAGS_max_normal_angle_deg), "at most 180 degrees");
  options.max_median_factor = RequireAtLeastZero("max_median_factor", FLAGS_max_median_factor);
  RequireFlag(FLAGS_kept_fraction > 0 && FLAGS_kept_fraction <= 1, "kept_fraction",
              Number(FLAGS_kept_fraction), "above 0, at most 1");
  options.kept_fraction = FLAGS_kept_fraction;
  RequireFlag(FLAGS_region_median_factor > 0 && std::isfinite(FLAGS_region_median_factor),
              "region_median_factor", Number(FLAGS_region_median_factor), "a positive number");
  if (RequireAtLeastZero("region_size_m", FLAGS_region_size_m) > 0) {
    options.regions = RegionOptions{FLAGS_region_size_m, FLAGS_region_median_factor};
  }
  return options;
}

}  // namespace icpscape
