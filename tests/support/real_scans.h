// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_REAL_SCANS_H_
#define ICPSCAPE_TESTS_SUPPORT_REAL_SCANS_H_

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "icpscape/io/kitti.h"

namespace icpscape {

/// Folder of KITTI odometry data, which are no part of the project: the environment variable
/// ICPSCAPE_KITTI_ROOT, or a folder beside the checkout.
inline std::filesystem::path KittiRoot() {
  const char* root = std::getenv("ICPSCAPE_KITTI_ROOT");
  return root != nullptr ? std::filesystem::path(root)
                         : std::filesystem::path(ICPSCAPE_SOURCE_DIR) / "../shared/data/kitti";
}

inline PointCloud KittiScan(const std::string& sequence, int frame) {
  DroppedPoints dropped;
  return ReadVelodyne(KittiFiles(KittiRoot(), sequence).Scan(frame), &dropped);
}

}  // namespace icpscape

/// The first line of every test on real scans.
#define ICPSCAPE_SKIP_WITHOUT_KITTI()                        \
  if (!std::filesystem::is_directory(icpscape::KittiRoot())) \
  GTEST_SKIP() << "no KITTI data: set ICPSCAPE_KITTI_ROOT to a folder with sequences/ and poses/"

#endif  // ICPSCAPE_TESTS_SUPPORT_REAL_SCANS_H_
