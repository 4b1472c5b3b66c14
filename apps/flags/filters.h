// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_FILTERS_H_
#define ICPSCAPE_APPS_FLAGS_FILTERS_H_

#include "icpscape/filtering/filter_chain.h"

namespace icpscape {

/// --artificial_blind_spot_m, --ego_filter_m and --octree_voxel_m. Throws UsageError.
FilterOptions FiltersFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_FILTERS_H_
