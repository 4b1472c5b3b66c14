// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_FILTERING_FILTER_CHAIN_H_
#define ICPSCAPE_SRC_FILTERING_FILTER_CHAIN_H_

#include <functional>
#include <string>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/filtering/kept_points.h"

namespace icpscape {

/// Which data filters a pair of scans goes through, the first stage of the paper's chain [paper
/// fig. 1, tab. 1]: in this order, each off where it is 0.
struct FilterOptions {
  double artificial_blind_spot_m = 0;  ///< Radius; see ArtificialBlindSpots.
  double ego_blind_spot_m = 0;         ///< Radius; see EgoBlindSpotFilter.
  double octree_voxel_m = 0;           ///< See OctreeCorrespondenceFilter.

  bool Any() const { return artificial_blind_spot_m > 0 || NeedEstimate(); }
  bool NeedEstimate() const { return ego_blind_spot_m > 0 || octree_voxel_m > 0; }
};

/// Applies the filters; those that compare the scans do so under the estimate. `report` (if any) is
/// called after each with its name (artificial_blind_spot, ego_filter, octree_filter) and what it
/// kept of what came to it. Throws ComputationError where one of them leaves no point.
KeptPoints ApplyFilters(
    const PointCloud& source, const PointCloud& target, const SE3d& T_target_source_estimate,
    const FilterOptions& options,
    const std::function<void(const std::string&, const KeptPoints&)>& report = nullptr);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_FILTERING_FILTER_CHAIN_H_
