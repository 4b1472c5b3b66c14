// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_SIMD_LEVELS_H_
#define ICPSCAPE_TESTS_SUPPORT_SIMD_LEVELS_H_

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "src/simd/level.h"

namespace icpscape::testing_support {

/// Runs at this level while it lives.
class ScopedSimdLevel {
 public:
  explicit ScopedSimdLevel(SimdLevel level) { setenv("ICPSCAPE_SIMD", SimdLevelName(level), 1); }
  ~ScopedSimdLevel() { unsetenv("ICPSCAPE_SIMD"); }
  ScopedSimdLevel(const ScopedSimdLevel&) = delete;
  ScopedSimdLevel& operator=(const ScopedSimdLevel&) = delete;
};

/// A fixture whose tests run at every level that the machine has.
class EverySimdLevel : public ::testing::TestWithParam<SimdLevel> {
 private:
  ScopedSimdLevel level_{GetParam()};
};

#define ICPSCAPE_INSTANTIATE_SIMD_LEVELS(fixture)                 \
  INSTANTIATE_TEST_SUITE_P(                                       \
      Level, fixture, ::testing::ValuesIn(SupportedSimdLevels()), \
      [](const auto& test) { return std::string(SimdLevelName(test.param)); })

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_SIMD_LEVELS_H_
