// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simd/level.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "icpscape/common/error.h"
#include "tests/support/simd_levels.h"

namespace icpscape {
namespace {

TEST(SimdLevel, IsTheWidestUnlessTheEnvironmentNamesOne) {
  EXPECT_EQ(ActiveSimdLevel(), SupportedSimdLevels().back());
  for (const SimdLevel level : SupportedSimdLevels()) {
    const testing_support::ScopedSimdLevel scoped(level);
    EXPECT_EQ(ActiveSimdLevel(), level);
  }
  EXPECT_EQ(SupportedSimdLevels().front(), SimdLevel::kBaseline);
  setenv("ICPSCAPE_SIMD", "", 1);
  EXPECT_EQ(ActiveSimdLevel(), SupportedSimdLevels().back());
  unsetenv("ICPSCAPE_SIMD");
}

TEST(SimdLevel, RefusesUnknownNames) {
  setenv("ICPSCAPE_SIMD", "sse9", 1);
  try {
    ActiveSimdLevel();
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("ICPSCAPE_SIMD=sse9: expected one of baseline"),
              std::string::npos);
  }
  unsetenv("ICPSCAPE_SIMD");
}

}  // namespace
}  // namespace icpscape
