// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/filters.h"

#include <gflags/gflags.h>

#include <cmath>
#include <utility>

#include "apps/run/app.h"
#include "src/common/text.h"

DEFINE_double(artificial_blind_spot_m, 0,
              "If positive: remove the points within this horizontal radius of the sensor (m); 5 "
              "in the paper, sec. 4.2.");
DEFINE_double(ego_filter_m, 0,
              "If positive: ego blind spot (ego overlap) filter with this radius (m); 5 in the "
              "paper's text, 6 in its data's file name.");
DEFINE_double(octree_voxel_m, 0,
              "If positive: Octree Correspondence Filter with voxels of this size (m); 0.1 in the "
              "paper.");

namespace icpscape {

FilterOptions FiltersFromFlags() {
  for (const auto& [flag, value] :
       {std::pair("artificial_blind_spot_m", FLAGS_artificial_blind_spot_m),
        std::pair("ego_filter_m", FLAGS_ego_filter_m),
        std::pair("octree_voxel_m", FLAGS_octree_voxel_m)}) {
    RequireFlag(value >= 0 && std::isfinite(value), flag, Number(value), "a length in m, or 0");
  }
  return {FLAGS_artificial_blind_spot_m, FLAGS_ego_filter_m, FLAGS_octree_voxel_m};
}

}  // namespace icpscape
