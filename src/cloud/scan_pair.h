// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_SCAN_PAIR_H_
#define ICPSCAPE_SRC_CLOUD_SCAN_PAIR_H_

#include <optional>
#include <string>

#include "icpscape/cloud/origin.h"
#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Two scans to register and what is known about the motion between them. Poses are
/// T_target_source: they map points of the source into the frame of the target, both as the clouds
/// have them: without their origins.
struct ScanPair {
  std::string title;  ///< For figures: "KITTI 00, scan 95 to 94".
  PointCloud source;
  PointCloud target;
  std::optional<SE3d> T_ground_truth;
  bool truth_is_exact = false;  ///< Simulated scans: the truth needs no check.
  /// The predicted pose (T_e in the paper): the motion of the scan before, where it is known.
  std::optional<SE3d> T_predicted;
  PairOrigins origins;  ///< Of the clouds: poses go to the user, and come from there, by them.

  /// For clouds as they were read and poses in the coordinates of the user: moves the clouds to one
  /// origin where that is near enough (see ShareOrigin), and takes the poses between their frames.
  void SettleOrigins();

  /// Swaps source and target and inverts the poses.
  void Reverse();
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_SCAN_PAIR_H_
