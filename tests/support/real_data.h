// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_REAL_DATA_H_
#define ICPSCAPE_TESTS_SUPPORT_REAL_DATA_H_

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace icpscape::testing_support {

/// Folder of KITTI odometry data: $ICPSCAPE_KITTI_ROOT, or ../shared/data/kitti beside the
/// checkout. Empty where there is none.
inline std::filesystem::path KittiRoot() {
  const char* root = std::getenv("ICPSCAPE_KITTI_ROOT");
  const std::filesystem::path path =
      root != nullptr ? std::filesystem::path(root)
                      : std::filesystem::path(ICPSCAPE_SOURCE_DIR) / ".." / "shared/data/kitti";
  return std::filesystem::is_directory(path / "sequences") ? path : std::filesystem::path();
}

}  // namespace icpscape::testing_support

/// KITTI cannot ship with the project: tests on real scans need the data beside the checkout.
#define ICPSCAPE_REQUIRE_KITTI(root)                                                          \
  const std::filesystem::path root = icpscape::testing_support::KittiRoot();                  \
  if (root.empty()) {                                                                         \
    GTEST_SKIP() << "no KITTI data: set ICPSCAPE_KITTI_ROOT to a folder with sequences/ and " \
                    "poses/";                                                                 \
  }                                                                                           \
  static_assert(true)

#endif  // ICPSCAPE_TESTS_SUPPORT_REAL_DATA_H_
