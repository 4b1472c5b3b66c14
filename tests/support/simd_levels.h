// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_SIMD_LEVELS_H_
#define ICPSCAPE_TESTS_SUPPORT_SIMD_LEVELS_H_

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "icpscape/simd/level.h"
#include "tests/support/named.h"

namespace icpscape::testing_support {

/// Runs at this level while it lives.
class ScopedSimdLevel {
 public:
  explicit ScopedSimdLevel(SimdLevel level) { setenv("ICPSCAPE_SIMD", NameOf(level), 1); }
  ~ScopedSimdLevel() { unsetenv("ICPSCAPE_SIMD"); }
  ScopedSimdLevel(const ScopedSimdLevel&) = delete;
  ScopedSimdLevel& operator=(const ScopedSimdLevel&) = delete;
};

/// A fixture whose tests run at every level that the machine has.
class EverySimdLevel : public ::testing::TestWithParam<Named<SimdLevel>> {
 public:
  static std::vector<Named<SimdLevel>> Levels() {
    std::vector<Named<SimdLevel>> levels;
    for (const SimdLevel level : SupportedSimdLevels()) {
      levels.push_back({NameOf(level), level});
    }
    return levels;
  }

 private:
  ScopedSimdLevel level_{GetParam().value};
};

#define ICPSCAPE_INSTANTIATE_SIMD_LEVELS(fixture)                                  \
  INSTANTIATE_TEST_SUITE_P(Level, fixture, ::testing::ValuesIn(fixture::Levels()), \
                           ::testing::PrintToStringParamName())

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_SIMD_LEVELS_H_
