// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_FILTERING_VOXEL_FILTER_H_
#define ICPSCAPE_SRC_FILTERING_VOXEL_FILTER_H_

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// The voxel grid filter: the centroid of the points of each voxel that has any, summed in double
/// in the order of the points, in the order of each voxel's first point. As in PCL's VoxelGrid the
/// lattice is fixed, its origin that of the frame; here a point is in voxel floor(c / voxel_size_m)
/// along each axis, as in the Octree Correspondence Filter, where PCL multiplies by the inverse in
/// float. A centroid lies in the voxel of its points: filtering again changes nothing.
///
/// Intensities are averaged, where there are any. Normals, rings and labels are left out: normals
/// are estimated afterwards, from the centroids; a centroid has no scan line, and its points may
/// have different labels.
///
/// Throws UsageError unless voxel_size_m is a length above 0, InputError for a point that is not
/// finite or beyond 2^20 voxels from the origin.
PointCloud VoxelFilter(const PointCloud& cloud, double voxel_size_m);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_FILTERING_VOXEL_FILTER_H_
