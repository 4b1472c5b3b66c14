// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/filters.h"

#include <gflags/gflags.h>

#include "apps/flags/octree_filter.h"
#include "apps/run/flag.h"

static const icpscape::FlagGroup group(__FILE__, "Filters", icpscape::kNotOfDraws);

DEFINE_double(
    artificial_blind_spot_m, 0,
    "If positive: removes the points within this horizontal radius of the sensor (m). The "
    "paper has 5 (sec. 4.2).");
DEFINE_double(
    ego_filter_m, 0,
    "If positive: the ego blind spot filter with this radius (m). The paper's text has 5, "
    "the file name of its data 6.");

namespace icpscape {

FilterOptions FiltersFromFlags() {
  return {RequireAtLeastZero("artificial_blind_spot_m", FLAGS_artificial_blind_spot_m),
          RequireAtLeastZero("ego_filter_m", FLAGS_ego_filter_m), OctreeVoxelFromFlags()};
}

}  // namespace icpscape
