// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/octree_filter.h"

#include <gflags/gflags.h>

#include "apps/run/flag.h"

static const icpscape::FlagGroup group(__FILE__, "Octree Correspondence Filter",
                                       icpscape::kNotOfDraws);

DEFINE_double(octree_voxel_m, 0,
              "If positive: the Octree Correspondence Filter with voxels of this size (m). The "
              "paper has 0.1.");

namespace icpscape {

double OctreeVoxelFromFlags() { return RequireAtLeastZero("octree_voxel_m", FLAGS_octree_voxel_m); }

}  // namespace icpscape
