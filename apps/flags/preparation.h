// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_PREPARATION_H_
#define ICPSCAPE_APPS_FLAGS_PREPARATION_H_

#include <string>
#include <vector>

#include "icpscape/preparation/prepared_scan.h"

namespace icpscape {

/// What is done to every scan, for these metrics: --elevation_correction_deg, --voxel_m,
/// --normal_neighbors, --normal_radius_m and the flags of features. Throws UsageError, also where
/// one of the metrics cannot use voxels.
PreparationOptions PreparationFromFlags(const std::vector<std::string>& metrics);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_PREPARATION_H_
