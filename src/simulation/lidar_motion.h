// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_LIDAR_MOTION_H_
#define ICPSCAPE_SRC_SIMULATION_LIDAR_MOTION_H_

#include <cmath>
#include <cstddef>
#include <vector>

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/residuals/lie.h"

namespace icpscape {

/// Where a lidar is while it turns once, in kScanPeriodS. The scan's instant, time 0, is the middle
/// of its turn, as in KITTI: the lidar turns counter-clockwise from backward over forward, at time
/// 0, to backward.
struct LidarMotion {
  /// It stands.
  LidarMotion(const SE3d& T) : T_world_lidar(T) {}  // NOLINT: a pose is such a motion.

  SE3d T_world_lidar;          ///< At time 0.
  Vec6 before = Vec6::Zero();  ///< Body twist per second before time 0 ...
  Vec6 after = Vec6::Zero();   ///< ... and after it.

  SE3d At(double time_s) const {
    return T_world_lidar * SE3d::Exp(time_s * (time_s < 0 ? before : after));
  }
  /// When the lidar looks into this direction (rad, 0 forward): within half a period of 0.
  static double TimeOf(double azimuth_rad) {
    return std::remainder(azimuth_rad, 2 * M_PI) / (2 * M_PI) * kScanPeriodS;
  }
};

/// One for each pose, kScanPeriodS apart, with a constant body twist from pose to pose; at both
/// ends it goes on.
inline std::vector<LidarMotion> MotionsThrough(const std::vector<SE3d>& T_world_lidar) {
  std::vector<LidarMotion> motions(T_world_lidar.begin(), T_world_lidar.end());
  for (std::size_t i = 0; i + 1 < motions.size(); ++i) {
    motions[i].after = motions[i + 1].before =
        (T_world_lidar[i].Inverse() * T_world_lidar[i + 1]).Log() / kScanPeriodS;
  }
  if (motions.size() > 1) {
    motions.front().before = motions.front().after;
    motions.back().after = motions.back().before;
  }
  return motions;
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_LIDAR_MOTION_H_
