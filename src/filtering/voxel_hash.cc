// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/voxel_hash.h"

#include <cmath>
#include <string>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {

void CheckVoxelSize(double voxel_size_m) {
  if (!(voxel_size_m > 0) || !std::isfinite(voxel_size_m)) {
    throw UsageError("voxel_size_m is " + Number(voxel_size_m) + "; expected a length above 0.");
  }
}

void ThrowBeyondVoxels(float coordinate_m, double voxel_size_m, const char* frame) {
  throw InputError("a point has coordinate " + Number(coordinate_m) + " m in " + frame +
                   "; expected it within 2^20 voxels of " + Number(voxel_size_m) + " m.");
}

VoxelNumbers::VoxelNumbers(std::size_t most_voxels) {
  while ((std::size_t{1} << bits_) < 2 * most_voxels) {
    ++bits_;
  }
  slots_.assign(std::size_t{1} << bits_, 0);
  keys_.reserve(most_voxels);
}

}  // namespace icpscape
