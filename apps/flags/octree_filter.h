// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_OCTREE_FILTER_H_
#define ICPSCAPE_APPS_FLAGS_OCTREE_FILTER_H_

namespace icpscape {

/// --octree_voxel_m, the voxels of the Octree Correspondence Filter (m); 0 is no filter. Throws
/// UsageError.
double OctreeVoxelFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_OCTREE_FILTER_H_
