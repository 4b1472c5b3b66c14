// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/neighbors/search_kernels.h"

namespace icpscape {

// Defined in search_kernels_LEVEL.cc.
namespace baseline {
extern const SearchKernels kSearchKernels;
}
#ifdef __x86_64__
namespace avx2 {
extern const SearchKernels kSearchKernels;
}
namespace avx512 {
extern const SearchKernels kSearchKernels;
}
#endif

const SearchKernels& SearchKernelsAt(SimdLevel level) {
  switch (level) {
#ifdef __x86_64__
    case SimdLevel::kAvx512:
      return avx512::kSearchKernels;
    case SimdLevel::kAvx2:
      return avx2::kSearchKernels;
#endif
    default:
      return baseline::kSearchKernels;
  }
}

}  // namespace icpscape
