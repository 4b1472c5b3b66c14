// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/features.h"

#include <gflags/gflags.h>

#include <cmath>

#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Edge and planar points");

DEFINE_string(smoothness, "printed",
              "LOAM's smoothness: printed (paper sec. 2.4), a_loam (squared, not normalised) or "
              "lio_sam (range differences).");
DEFINE_string(smoothness_neighborhood, "ring",
              "Points that surround a point: ring (LOAM, A-LOAM), k_nearest or radius.");
DEFINE_int32(ring_points_per_side, 5,
             "With ring: points to either side (A-LOAM has 5, the paper gives no number).");
DEFINE_int32(smoothness_neighbors, 10, "With k_nearest: number of other points.");
DEFINE_double(smoothness_radius_m, 0.5, "With radius: radius of the neighbourhood (m).");
DEFINE_double(
    planar_below, NAN,
    "Points of less smoothness are planar. The default depends on the formula: 0.1 printed "
    "(paper sec. 4.2), 0.1 A-LOAM, 0.1 LIO-SAM.");
DEFINE_double(
    edge_from, NAN,
    "Points of at least this smoothness are edges. The default depends on the formula: 0.1 "
    "printed (\"all other points\"), 0.1 A-LOAM, 1 LIO-SAM.");
DEFINE_string(feature_caps, "none",
              "Most features per region: none (paper), loam (2 edges, 4 planar in each of 4), "
              "a_loam_sharp (2, 4 in each of 6) or a_loam_less_sharp (20, 4).");

namespace icpscape {

FeatureOptions FeaturesFromFlags() {
  FeatureOptions options =
      ConventionalFeatureOptions(FromName<SmoothnessFormula>(FLAGS_smoothness));
  options.smoothness.neighborhood = FromName<SmoothnessNeighborhood>(FLAGS_smoothness_neighborhood);
  options.smoothness.ring_points_per_side = FLAGS_ring_points_per_side;
  RequireFlag(FLAGS_smoothness_neighbors <= 1000, "smoothness_neighbors",
              std::to_string(FLAGS_smoothness_neighbors), "at most 1000");
  options.smoothness.num_neighbors = FLAGS_smoothness_neighbors;
  options.smoothness.radius_m = FLAGS_smoothness_radius_m;
  if (!std::isnan(FLAGS_planar_below)) {
    options.planar_below = FLAGS_planar_below;
  }
  if (!std::isnan(FLAGS_edge_from)) {
    options.edge_from = FLAGS_edge_from;
  }
  const FeatureCaps caps[] = {{}, kLoamCaps, kALoamSharpCaps, kALoamLessSharpCaps};
  options.caps = caps[IndexOfName("feature caps", FLAGS_feature_caps,
                                  {"none", "loam", "a_loam_sharp", "a_loam_less_sharp"})];
  return options;
}

}  // namespace icpscape
