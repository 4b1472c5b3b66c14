// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/local_fit.h"

#include <gflags/gflags.h>

#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Lines and patches of neighbours");

DEFINE_int32(fit_neighbors, 5, "Neighbours of a line or patch (paper sec. 4.2, A-LOAM).");
DEFINE_double(fit_eigenvalue_ratio, 3,
              "A line's first eigenvalue exceeds this times the second, a patch's second this "
              "times the third (paper sec. 4.2).");
DEFINE_double(fit_max_smallest_eigenvalue_m2, 1e-4,
              "A patch's smallest eigenvalue is below this (paper sec. 4.2, without unit; m^2).");
DEFINE_string(fit_eigenvalue_scale, "over_n",
              "Divisor of the sums of squares about the mean: scatter (none), over_n or "
              "over_n_minus_one; the paper does not say.");
DEFINE_string(fit_anchor, "centroid",
              "A point of the line or patch: centroid (LOAM's mapping, A-LOAM) or nearest.");
DEFINE_double(fit_max_neighbor_distance_m, 0,
              "Farthest neighbour of a fit (m); 0 is no limit, 1 in A-LOAM.");
DEFINE_double(patch_leg_m, 0.5,
              "Legs of the patch's right-angled virtual triangle (m); the paper gives no size.");

namespace icpscape {

LocalFitOptions LocalFitFromFlags() {
  RequireFlag(FLAGS_fit_neighbors >= 3 && FLAGS_fit_neighbors <= 1000, "fit_neighbors",
              std::to_string(FLAGS_fit_neighbors), "at least 3, at most 1000");
  RequireFlag(FLAGS_patch_leg_m > 0, "patch_leg_m", Number(FLAGS_patch_leg_m), "a positive length");
  LocalFitOptions options;
  options.num_neighbors = FLAGS_fit_neighbors;
  options.eigenvalue_ratio = RequireAtLeastZero("fit_eigenvalue_ratio", FLAGS_fit_eigenvalue_ratio);
  options.max_smallest_eigenvalue_m2 =
      RequireAtLeastZero("fit_max_smallest_eigenvalue_m2", FLAGS_fit_max_smallest_eigenvalue_m2);
  options.eigenvalue_scale = FromName<EigenvalueScale>(FLAGS_fit_eigenvalue_scale);
  options.anchor = FromName<FitAnchor>(FLAGS_fit_anchor);
  options.max_neighbor_distance_m =
      RequireAtLeastZero("fit_max_neighbor_distance_m", FLAGS_fit_max_neighbor_distance_m);
  options.triangle_leg_m = FLAGS_patch_leg_m;
  return options;
}

}  // namespace icpscape
