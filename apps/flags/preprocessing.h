// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_PREPROCESSING_H_
#define ICPSCAPE_APPS_FLAGS_PREPROCESSING_H_

#include <string>
#include <vector>

#include "src/odometry/preprocessing.h"

namespace icpscape {

/// What is done to every scan, for these metrics: --elevation_correction_deg, --voxel_m,
/// --normal_neighbors, --normal_radius_m and the flags of features. Throws UsageError, also where
/// one of the metrics cannot be had of voxels.
PreprocessingOptions PreprocessingFromFlags(const std::vector<std::string>& metrics);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_PREPROCESSING_H_
