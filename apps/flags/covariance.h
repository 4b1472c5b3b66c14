// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_COVARIANCE_H_
#define ICPSCAPE_APPS_FLAGS_COVARIANCE_H_

#include "icpscape/covariance/covariance.h"

namespace icpscape {

/// --assumed_range_noise_m, --assumed_ring_bias_m, --cluster_m and --rematching_step_m. Throws
/// UsageError.
CovarianceOptions CovarianceFromFlags();

/// --length_scale_m. Throws UsageError.
double LengthScaleFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_COVARIANCE_H_
