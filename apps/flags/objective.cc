// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/objective.h"

#include <gflags/gflags.h>

#include <cmath>

#include "apps/flags/run.h"
#include "apps/run/app.h"
#include "src/common/text.h"
#include "src/objective/loss.h"

DEFINE_string(metrics, "point_to_point,point_to_plane,symmetric",
              "Metrics, separated by commas; icpscape-list_metrics names them.");
DEFINE_string(loss, "none",
              "Loss on each residual: none, huber, soft_l_one, cauchy, arctan, tukey, tolerant. "
              "planar_to_patch keeps its own, SoftLOneLoss(1), under none. It bends the cost; the "
              "paper's RMSE knows no loss.");
DEFINE_double(loss_scale_m, 0.1, "Length at which the loss bends (m).");

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

DEFINE_string(smoothness, "printed",
              "LOAM's smoothness: printed (paper sec. 2.4), a_loam (squared, not normalised) or "
              "lio_sam (range differences).");
DEFINE_string(smoothness_neighborhood, "ring",
              "Points that surround a point: ring (LOAM, A-LOAM), k_nearest or radius.");
DEFINE_int32(ring_points_per_side, 5,
             "Of ring: points to either side (A-LOAM; none in the paper).");
DEFINE_int32(smoothness_neighbors, 10, "Of k_nearest: other points.");
DEFINE_double(smoothness_radius_m, 0.5, "Of radius (m).");
DEFINE_double(planar_below, NAN,
              "Planar points have less smoothness; the default is the formula's convention: 0.1 "
              "printed (paper sec. 4.2), 0.1 A-LOAM, 0.1 LIO-SAM.");
DEFINE_double(edge_from, NAN,
              "Edge points have at least this; default 0.1 printed (\"all other points\"), 0.1 "
              "A-LOAM, 1 LIO-SAM.");
DEFINE_string(feature_caps, "none",
              "Most features per region: none (paper), loam (2 edges, 4 planar in each of 4), "
              "a_loam_sharp (2, 4 in each of 6) or a_loam_less_sharp (20, 4).");

DEFINE_int32(fit_neighbors, 5, "Neighbours of a line or patch (paper sec. 4.2, A-LOAM).");
DEFINE_double(fit_eigenvalue_ratio, 3,
              "A line's first eigenvalue exceeds this times the second, a patch's second this "
              "times the third (paper sec. 4.2).");
DEFINE_double(fit_max_smallest_eigenvalue_m2, 1e-4,
              "A patch's smallest eigenvalue is below this (paper sec. 4.2, without unit; m^2).");
DEFINE_string(fit_eigenvalue_scale, "over_n",
              "Sum of squares about the mean: scatter (as it is), over_n or over_n_minus_one; the "
              "paper does not say.");
DEFINE_string(fit_anchor, "centroid",
              "A point of the line or patch: centroid (LOAM's mapping, A-LOAM) or nearest.");
DEFINE_double(fit_max_neighbor_distance_m, 0,
              "Farthest neighbour of a fit (m); 0 is no limit, 1 in A-LOAM.");
DEFINE_double(patch_leg_m, 0.5,
              "Legs of the patch's right-angled virtual triangle (m); the paper gives no size.");

namespace icpscape {
namespace {

double AtLeastZero(const char* flag, double value) {
  RequireFlag(value >= 0 && std::isfinite(value), flag, Number(value), "a number of at least 0");
  return value;
}

MatchingOptions MatchingFromFlags() {
  MatchingOptions options;
  options.max_distance_m = AtLeastZero("max_distance_m", FLAGS_max_distance_m);
  AtLeastZero("reciprocal_epsilon_m", FLAGS_reciprocal_epsilon_m);
  if (FLAGS_reciprocal) {
    options.reciprocal_epsilon_m = FLAGS_reciprocal_epsilon_m;
  }
  options.max_normal_angle_rad =
      AtLeastZero("max_normal_angle_deg", FLAGS_max_normal_angle_deg) * M_PI / 180;
  RequireFlag(FLAGS_max_normal_angle_deg <= 180, "max_normal_angle_deg",
              Number(FLAGS_max_normal_angle_deg), "at most 180 degrees");
  options.max_median_factor = AtLeastZero("max_median_factor", FLAGS_max_median_factor);
  RequireFlag(FLAGS_kept_fraction > 0 && FLAGS_kept_fraction <= 1, "kept_fraction",
              Number(FLAGS_kept_fraction), "above 0, at most 1");
  options.kept_fraction = FLAGS_kept_fraction;
  RequireFlag(FLAGS_region_median_factor > 0 && std::isfinite(FLAGS_region_median_factor),
              "region_median_factor", Number(FLAGS_region_median_factor), "a positive number");
  if (AtLeastZero("region_size_m", FLAGS_region_size_m) > 0) {
    options.regions = RegionOptions{FLAGS_region_size_m, FLAGS_region_median_factor};
  }
  return options;
}

}  // namespace

std::vector<std::string> MetricsFromFlags() {
  std::vector<std::string> metrics = Split(FLAGS_metrics);
  RequireFlag(!metrics.empty() && Join(metrics, ",") == FLAGS_metrics, "metrics", FLAGS_metrics,
              "at least one metric, separated by single commas");
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    MetricFunctionsOf(metrics[i]);  // Throws for an unknown one.
    for (std::size_t j = 0; j < i; ++j) {
      RequireFlag(metrics[i] != metrics[j], "metrics", FLAGS_metrics, "each metric once");
    }
  }
  return metrics;
}

FeatureOptions FeaturesFromFlags() {
  const auto formula = static_cast<SmoothnessFormula>(
      IndexOfName("smoothness", FLAGS_smoothness, {"printed", "a_loam", "lio_sam"}));
  FeatureOptions options = ConventionalFeatureOptions(formula);
  options.smoothness.neighborhood = static_cast<SmoothnessNeighborhood>(IndexOfName(
      "smoothness neighbourhood", FLAGS_smoothness_neighborhood, {"ring", "k_nearest", "radius"}));
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

ObjectiveSetOptions ObjectiveSetFromFlags() {
  ObjectiveSetOptions options;
  options.matching = MatchingFromFlags();
  options.loss = MakeLoss(FLAGS_loss, FLAGS_loss_scale_m);
  RequireFlag(FLAGS_fit_neighbors >= 3 && FLAGS_fit_neighbors <= 1000, "fit_neighbors",
              std::to_string(FLAGS_fit_neighbors), "at least 3, at most 1000");
  RequireFlag(FLAGS_patch_leg_m > 0, "patch_leg_m", Number(FLAGS_patch_leg_m), "a positive length");
  options.line.num_neighbors = FLAGS_fit_neighbors;
  options.line.eigenvalue_ratio = AtLeastZero("fit_eigenvalue_ratio", FLAGS_fit_eigenvalue_ratio);
  options.line.max_smallest_eigenvalue_m2 =
      AtLeastZero("fit_max_smallest_eigenvalue_m2", FLAGS_fit_max_smallest_eigenvalue_m2);
  options.line.eigenvalue_scale = EigenvalueScaleFromName(FLAGS_fit_eigenvalue_scale);
  options.line.anchor = FitAnchorFromName(FLAGS_fit_anchor);
  options.line.max_neighbor_distance_m =
      AtLeastZero("fit_max_neighbor_distance_m", FLAGS_fit_max_neighbor_distance_m);
  options.line.triangle_leg_m = FLAGS_patch_leg_m;
  options.patch = options.line;
  return options;
}

}  // namespace icpscape
