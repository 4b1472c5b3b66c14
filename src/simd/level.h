// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMD_LEVEL_H_
#define ICPSCAPE_SRC_SIMD_LEVEL_H_

#include <string>
#include <vector>

#include "icpscape/common/names.h"

namespace icpscape {

/// The instruction sets that hot loops are compiled for, the narrowest first. All of them compute
/// the same bits.
enum class SimdLevel {
  kBaseline,  ///< What every machine of the architecture has: SSE2 on x86-64.
  kAvx2,
  kAvx512,  ///< F, BW, DQ and VL.
};
template <>
struct Names<SimdLevel> {
  static constexpr const char* kWhat = "SIMD level";
  static constexpr const char* kNames[] = {"baseline", "avx2", "avx512"};
};

/// The levels that this machine can run, narrowest first.
const std::vector<SimdLevel>& SupportedSimdLevels();

/// The level to run at: the widest supported one, or what the environment variable ICPSCAPE_SIMD
/// names. Throws UsageError for a name that is unknown or not supported here.
SimdLevel ActiveSimdLevel();

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMD_LEVEL_H_
