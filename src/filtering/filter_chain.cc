// SPDX-License-Identifier: BSD-3-Clause
#include "src/filtering/filter_chain.h"

#include <utility>

#include "src/common/error.h"
#include "src/filtering/ego_blind_spot.h"
#include "src/filtering/octree_correspondence_filter.h"

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

FilteredPair ApplyFilters(
    const PointCloud& source, const PointCloud& target, const SE3d& T_e,
    const FilterOptions& options,
    const std::function<void(const std::string&, const FilteredPair&)>& report) {
  FilteredPair all = {source, target, std::vector<char>(source.size(), 1),
                      std::vector<char>(target.size(), 1)};
  const auto apply = [&](const std::string& name, FilteredPair filtered) {
    if (report) {
      report(name, filtered);
    }
    if (filtered.source.empty() || filtered.target.empty()) {
      throw ComputationError(name + ": no point is left; expected some to agree.");
    }
    Compose(filtered.keep_source, &all.keep_source);
    Compose(filtered.keep_target, &all.keep_target);
    all.source = std::move(filtered.source);
    all.target = std::move(filtered.target);
  };
  if (options.artificial_blind_spot_m > 0) {
    apply("artificial_blind_spot",
          ArtificialBlindSpots(all.source, all.target, options.artificial_blind_spot_m));
  }
  if (options.ego_blind_spot_m > 0) {
    apply("ego_filter",
          EgoBlindSpotFilter(all.source, all.target, T_e, options.ego_blind_spot_m));
  }
  if (options.octree_voxel_m > 0) {
    apply("octree_filter", OctreeCorrespondenceFilter(all.source, all.target, T_e,
                                                      {options.octree_voxel_m}));
  }
  return all;
}

}  // namespace icpscape
