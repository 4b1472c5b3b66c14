// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/filter_chain.h"

#include <algorithm>

#include "icpscape/common/error.h"
#include "icpscape/filtering/ego_blind_spot.h"
#include "icpscape/filtering/octree_correspondence_filter.h"

namespace icpscape {
namespace {

// keep[i] of those that were kept so far -> of all.
void Compose(const std::vector<char>& keep, std::vector<char>* all) {
  std::size_t next = 0;
  for (char& kept : *all) {
    kept = kept != 0 ? keep[next++] : kept;
  }
}

}  // namespace

KeptPoints ApplyFilters(const PointCloud& source, const PointCloud& target, const SE3d& T_e,
                        const FilterOptions& options,
                        const std::function<void(const std::string&, const KeptPoints&)>& report) {
  KeptPoints all = {std::vector<char>(source.size(), 1), std::vector<char>(target.size(), 1)};
  const auto apply = [&](const std::string& name, const auto& filter) {
    const KeptPoints kept = filter(source.Select(all.source), target.Select(all.target));
    if (report) {
      report(name, kept);
    }
    for (const std::vector<char>* keep : {&kept.source, &kept.target}) {
      if (std::find(keep->begin(), keep->end(), 1) == keep->end()) {
        throw ComputationError(name + ": no point is left; expected at least one.");
      }
    }
    Compose(kept.source, &all.source);
    Compose(kept.target, &all.target);
  };
  if (options.artificial_blind_spot_m > 0) {
    apply("artificial_blind_spot", [&](const PointCloud& s, const PointCloud& t) {
      return ArtificialBlindSpots(s, t, options.artificial_blind_spot_m);
    });
  }
  if (options.ego_blind_spot_m > 0) {
    apply("ego_filter", [&](const PointCloud& s, const PointCloud& t) {
      return EgoBlindSpotFilter(s, t, T_e, options.ego_blind_spot_m);
    });
  }
  if (options.octree_voxel_m > 0) {
    apply("octree_filter", [&](const PointCloud& s, const PointCloud& t) {
      return OctreeCorrespondenceFilter(s, t, T_e, {options.octree_voxel_m});
    });
  }
  return all;
}

}  // namespace icpscape
