// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/covariance.h"

#include <gflags/gflags.h>

#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Covariance estimators");

DEFINE_double(assumed_range_noise_m, icpscape::CovarianceOptions().range_noise_m,
              "Standard deviation of independent range noise that censi assumes (m).");
DEFINE_double(
    assumed_ring_bias_m, icpscape::CovarianceOptions().ring_bias_m,
    "Standard deviation of the lasers' constant errors that censi_ring_bias assumes (m).");
DEFINE_double(cluster_m, icpscape::CovarianceOptions().cluster_m,
              "Edge of the cubes whose pairs count as correlated in the clustered sandwich (m).");
DEFINE_double(rematching_step_m, icpscape::CovarianceOptions().rematching_step_m,
              "Half the distance over which sandwich_rematched differences its Hessian (m).");
DEFINE_double(length_scale_m, 10,
              "Lever arm L at which rotations are measured as lengths (m): eigenvalues and "
              "directions are those of the Hessian in [L omega; v].");

namespace icpscape {

CovarianceOptions CovarianceFromFlags() {
  // Checked here, since the flags have other names than the options.
  RequireFlag(FLAGS_assumed_range_noise_m >= 0 && FLAGS_assumed_range_noise_m <= 10,
              "assumed_range_noise_m", Number(FLAGS_assumed_range_noise_m), "0 to 10 m");
  RequireFlag(FLAGS_assumed_ring_bias_m >= 0 && FLAGS_assumed_ring_bias_m <= 10,
              "assumed_ring_bias_m", Number(FLAGS_assumed_ring_bias_m), "0 to 10 m");
  CovarianceOptions options;
  options.range_noise_m = FLAGS_assumed_range_noise_m;
  options.ring_bias_m = FLAGS_assumed_ring_bias_m;
  options.cluster_m = FLAGS_cluster_m;
  options.rematching_step_m = FLAGS_rematching_step_m;
  options.Check();
  return options;
}

double LengthScaleFromFlags() {
  RequireFlag(FLAGS_length_scale_m > 0 && FLAGS_length_scale_m <= 1e6, "length_scale_m",
              Number(FLAGS_length_scale_m), "a positive length of at most 1e6 m");
  return FLAGS_length_scale_m;
}

}  // namespace icpscape
