// SPDX-License-Identifier: BSD-3-Clause
#include "src/filtering/octree_correspondence_filter.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "src/common/error.h"
#include "src/common/text.h"

namespace icpscape {
namespace {

constexpr int kBitsPerAxis = 21;
constexpr double kMostVoxels = 1 << (kBitsPerAxis - 1);

// The voxel's three indices in one word, 21 bits each.
std::uint64_t VoxelKey(const Eigen::Vector3f& point, double voxel_size_m) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double index = std::floor(static_cast<double>(point[axis]) / voxel_size_m);
    if (!(index >= -kMostVoxels && index < kMostVoxels)) {
      throw InputError("a point has coordinate " + Number(point[axis]) +
                       " m in the target frame; expected it within 2^20 voxels of " +
                       Number(voxel_size_m) + " m.");
    }
    key = (key << kBitsPerAxis) | static_cast<std::uint64_t>(index + kMostVoxels);
  }
  return key;
}

// An open-addressing hash of the voxels that a cloud occupies.
class VoxelSet {
 public:
  explicit VoxelSet(std::size_t most_voxels) {
    while ((std::size_t{1} << bits_) < 2 * most_voxels) {
      ++bits_;
    }
    keys_.assign(std::size_t{1} << bits_, kEmpty);
  }

  /// The slot of the voxel, taken now if it is new.
  std::size_t Insert(std::uint64_t key) {
    const std::size_t slot = Slot(key);
    keys_[slot] = key;
    return slot;
  }

  /// The slot of the voxel, or where it would go.
  std::size_t Slot(std::uint64_t key) const {
    constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15;  // 2^64 / phi: Fibonacci hashing.
    std::size_t slot = (key * kGoldenRatio) >> (64 - bits_);
    while (keys_[slot] != key && keys_[slot] != kEmpty) {
      slot = (slot + 1) & (keys_.size() - 1);
    }
    return slot;
  }

  bool IsEmpty(std::size_t slot) const { return keys_[slot] == kEmpty; }
  std::size_t num_slots() const { return keys_.size(); }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};  // No key has its 64th bit set.
  int bits_ = 4;
  std::vector<std::uint64_t> keys_;
};

}  // namespace

FilteredPair OctreeCorrespondenceFilter(const PointCloud& source, const PointCloud& target,
                                        const SE3d& T_target_source_estimate,
                                        const OctreeFilterOptions& options) {
  const double voxel = options.voxel_size_m;
  if (!(voxel > 0) || !std::isfinite(voxel)) {
    throw UsageError("voxel_size_m is " + Number(voxel) + "; expected a length above 0.");
  }
  VoxelSet voxels(target.size());
  std::vector<std::size_t> target_slot(target.size());
  for (std::size_t j = 0; j < target.size(); ++j) {
    target_slot[j] = voxels.Insert(VoxelKey(target.Point(j).cast<float>(), voxel));
  }
  std::vector<char> in_both(voxels.num_slots(), 0);
  std::vector<char> keep_source(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Vec3 moved = T_target_source_estimate * source.Point(i);
    const std::size_t slot = voxels.Slot(VoxelKey(moved.cast<float>(), voxel));
    keep_source[i] = voxels.IsEmpty(slot) ? 0 : 1;
    in_both[slot] = keep_source[i];
  }
  std::vector<char> keep_target(target.size());
  for (std::size_t j = 0; j < target.size(); ++j) {
    keep_target[j] = in_both[target_slot[j]];
  }
  return SelectPair(source, target, std::move(keep_source), std::move(keep_target));
}

}  // namespace icpscape
