// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_FILTERING_VOXEL_HASH_H_
#define ICPSCAPE_SRC_FILTERING_VOXEL_HASH_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace icpscape {

/// Throws UsageError unless it is a length above 0.
void CheckVoxelSize(double voxel_size_m);

/// The voxel lattice has 2^21 voxels along each axis, half of them below 0.
inline constexpr int kVoxelBitsPerAxis = 21;
inline constexpr int kMostVoxelsFromOrigin = 1 << (kVoxelBitsPerAxis - 1);

/// InputError: the coordinate is beyond the lattice, or no number. `frame` as in "the target
/// frame".
[[noreturn]] void ThrowBeyondVoxels(float coordinate_m, double voxel_size_m, const char* frame);

/// The voxel of a point on the lattice whose origin is the frame's: floor(c / voxel_size_m) along
/// each axis, c being the float coordinate and the quotient taken in double, in one word of three
/// times 21 bits, x the highest. Throws InputError for a point beyond 2^20 voxels from the origin.
inline std::uint64_t VoxelKey(const Eigen::Vector3f& point, double voxel_size_m,
                              const char* frame) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double quotient = static_cast<double>(point[axis]) / voxel_size_m;
    if (!(quotient >= -kMostVoxelsFromOrigin && quotient < kMostVoxelsFromOrigin)) {
      ThrowBeyondVoxels(point[axis], voxel_size_m, frame);
    }
    // Without SSE4.1 std::floor is a call, and takes as long as the division.
    const int truncated = static_cast<int>(quotient);
    const int index = truncated - (truncated > quotient ? 1 : 0);
    key = (key << kVoxelBitsPerAxis) | static_cast<std::uint64_t>(index + kMostVoxelsFromOrigin);
  }
  return key;
}

/// Numbers the voxels that points occupy: 0, 1, 2 and so on, in the order in which they first come.
/// An open-addressing hash, at most half full, whose slots hold numbers and leave the keys to a
/// list: four bytes a slot instead of sixteen, so that those of a whole scan stay in the cache.
class VoxelNumbers {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Of no more than so many voxels, and fewer than 2^32 - 1.
  explicit VoxelNumbers(std::size_t most_voxels);

  /// The number of the voxel, given now if it is new.
  std::uint32_t Insert(std::uint64_t key) {
    if (key == key_before_) {  // Scans come line by line.
      return number_before_;
    }
    const std::size_t slot = Slot(key);
    if (slots_[slot] == 0) {
      keys_.push_back(key);
      slots_[slot] = static_cast<std::uint32_t>(keys_.size());
    }
    key_before_ = key;
    number_before_ = slots_[slot] - 1;
    return number_before_;
  }

  /// The number of the voxel, or kNone.
  std::uint32_t Find(std::uint64_t key) const { return slots_[Slot(key)] - 1; }

  std::size_t size() const { return keys_.size(); }

 private:
  // The slot of the voxel, or where it would go.
  std::size_t Slot(std::uint64_t key) const {
    constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15;  // 2^64 / phi: Fibonacci hashing.
    std::size_t slot = (key * kGoldenRatio) >> (64 - bits_);
    while (slots_[slot] != 0 && keys_[slots_[slot] - 1] != key) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
  }

  int bits_ = 4;
  std::vector<std::uint32_t> slots_;  // The number plus 1; 0 in an empty slot.
  std::vector<std::uint64_t> keys_;
  std::uint64_t key_before_ = ~std::uint64_t{0};  // No key has its 64th bit set.
  std::uint32_t number_before_ = kNone;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_FILTERING_VOXEL_HASH_H_
