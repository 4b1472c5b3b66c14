// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simd/level.h"

#include <cstdlib>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

std::vector<SimdLevel> DetectLevels() {
  std::vector<SimdLevel> levels = {SimdLevel::kBaseline};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) {
    levels.push_back(SimdLevel::kAvx2);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
      levels.push_back(SimdLevel::kAvx512);
    }
  }
#endif
  return levels;
}

}  // namespace

const std::vector<SimdLevel>& SupportedSimdLevels() {
  static const std::vector<SimdLevel> levels = DetectLevels();
  return levels;
}

SimdLevel ActiveSimdLevel() {
  const char* wanted = std::getenv("ICPSCAPE_SIMD");
  if (wanted == nullptr || *wanted == '\0') {
    return SupportedSimdLevels().back();
  }
  std::vector<std::string> names;
  for (const SimdLevel level : SupportedSimdLevels()) {
    if (NameOf(level) == std::string(wanted)) {
      return level;
    }
    names.emplace_back(NameOf(level));
  }
  throw UsageError("ICPSCAPE_SIMD=" + std::string(wanted) + ": expected one of " + Join(names) +
                   ", which this machine can run.");
}

}  // namespace icpscape
