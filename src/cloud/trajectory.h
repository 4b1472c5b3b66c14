// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_TRAJECTORY_H_
#define ICPSCAPE_SRC_CLOUD_TRAJECTORY_H_

#include <vector>

#include "icpscape/residuals/lie.h"

namespace icpscape {

/// Poses T_world_body in the order of their frames; body is the left camera in KITTI's files, often
/// the lidar in ours.
struct Trajectory {
  std::vector<SE3d> T_world_body;
  std::vector<double> times_s;  ///< One per pose, increasing; empty where the file has none.
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_TRAJECTORY_H_
