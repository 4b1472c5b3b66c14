// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/block_kernels.h"

namespace icpscape {

// Defined in block_kernels_LEVEL.cc.
namespace baseline {
extern const BlockKernel* const kBlockKernels;
}
#ifdef __x86_64__
namespace avx2 {
extern const BlockKernel* const kBlockKernels;
}
namespace avx512 {
extern const BlockKernel* const kBlockKernels;
}
#endif

BlockKernel BlockKernelOf(std::size_t metric, SimdLevel level) {
  switch (level) {
#ifdef __x86_64__
    case SimdLevel::kAvx512:
      return avx512::kBlockKernels[metric];
    case SimdLevel::kAvx2:
      return avx2::kBlockKernels[metric];
#endif
    default:
      return baseline::kBlockKernels[metric];
  }
}

}  // namespace icpscape
