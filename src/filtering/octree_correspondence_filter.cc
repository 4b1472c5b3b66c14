// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/octree_correspondence_filter.h"

#include <cstdint>
#include <utility>

#include "icpscape/filtering/voxel_hash.h"

namespace icpscape {

KeptPoints OctreeCorrespondenceFilter(const PointCloud& source, const PointCloud& target,
                                      const SE3d& T_target_source_estimate,
                                      const OctreeFilterOptions& options) {
  CheckVoxelSize(options.voxel_size_m);
  const auto key_of = [&](const Vec3& point) {
    return VoxelKey(point.cast<float>(), options.voxel_size_m, "the target frame");
  };
  VoxelNumbers voxels(target.size());
  std::vector<std::uint32_t> target_voxel(target.size());
  for (std::size_t j = 0; j < target.size(); ++j) {
    target_voxel[j] = voxels.Insert(key_of(target.Point(j)));
  }
  std::vector<char> in_both(voxels.size(), 0);
  std::vector<char> keep_source(source.size(), 0);
  for (std::size_t i = 0; i < source.size(); ++i) {
    const std::uint32_t voxel = voxels.Find(key_of(T_target_source_estimate * source.Point(i)));
    if (voxel != VoxelNumbers::kNone) {
      keep_source[i] = 1;
      in_both[voxel] = 1;
    }
  }
  std::vector<char> keep_target(target.size());
  for (std::size_t j = 0; j < target.size(); ++j) {
    keep_target[j] = in_both[target_voxel[j]];
  }
  return {std::move(keep_source), std::move(keep_target)};
}

}  // namespace icpscape
