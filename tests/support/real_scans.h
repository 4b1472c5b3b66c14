// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_REAL_SCANS_H_
#define ICPSCAPE_TESTS_SUPPORT_REAL_SCANS_H_

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "src/io/kitti.h"

namespace icpscape {

/// Where the real scans lie; they are no part of the project.
inline std::filesystem::path KittiRoot() {
  return std::filesystem::path(ICPSCAPE_SOURCE_DIR) / "../shared/data/kitti";
}

inline PointCloud KittiScan(const std::string& sequence, int frame) {
  DroppedPoints dropped;
  return ReadVelodyne(KittiSequence(KittiRoot(), sequence).ScanPath(frame), &dropped);
}

}  // namespace icpscape

/// First line of a test on real scans.
#define ICPSCAPE_SKIP_WITHOUT_KITTI()                        \
  if (!std::filesystem::is_directory(icpscape::KittiRoot())) \
  GTEST_SKIP() << "no KITTI scans at ../shared/data/kitti beside the project's folder"

#endif  // ICPSCAPE_TESTS_SUPPORT_REAL_SCANS_H_
