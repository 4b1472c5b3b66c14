// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_FILTERING_OCTREE_CORRESPONDENCE_FILTER_H_
#define ICPSCAPE_SRC_FILTERING_OCTREE_CORRESPONDENCE_FILTER_H_

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/filtering/kept_points.h"

namespace icpscape {

struct OctreeFilterOptions {
  /// The paper's: emergency braking at 10 m/s^2 puts the predicted pose off by 1/2 10 0.1^2 = 0.05
  /// m within a revolution, less than a voxel [paper sec. 4.2].
  double voxel_size_m = 0.1;
};

/// The Octree Correspondence Filter [paper sec. 2.7, Alg. 1]: the estimate, usually the predicted
/// pose (T_e in the paper), takes the source into the target frame; then the points of every voxel
/// that only one scan occupies are dropped: dynamic objects and what only one scan sees.
///
/// The algorithm's leaves are all it needs of its octrees, so the voxels are kept in a flat hash:
/// linear in the number of points, whatever the number of dynamic objects. The lattice is fixed,
/// its origin that of the target frame (an octree that adapts its box to the data gives each scan
/// another): a point is in voxel floor(c / voxel_size_m) along each axis, c being the float
/// coordinate and the quotient taken in double. Moved points are rounded to float first, as in
/// PointCloud::Transformed. The braking argument holds for surfaces along the motion: of those
/// across it, an offset of half a voxel moves half into the next one.
///
/// The filter keeps what agrees under the estimate, so it favours the estimate itself. Throws
/// UsageError unless voxel_size_m is a length above 0, InputError for a point beyond 2^20 voxels
/// from the origin.
KeptPoints OctreeCorrespondenceFilter(const PointCloud& source, const PointCloud& target,
                                      const SE3d& T_target_source_estimate,
                                      const OctreeFilterOptions& options);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_FILTERING_OCTREE_CORRESPONDENCE_FILTER_H_
