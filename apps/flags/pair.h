// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_PAIR_H_
#define ICPSCAPE_APPS_FLAGS_PAIR_H_

#include <optional>
#include <string>
#include <vector>

#include "apps/flags/run.h"
#include "src/cloud/features.h"
#include "src/cloud/point_cloud.h"
#include "src/io/manifest.h"
#include "src/minimizer/ground_truth_check.h"

namespace icpscape {

/// Two scans to register, as the flags of landscape and register name them.
struct ScanPair {
  PointCloud source;
  PointCloud target;
  std::optional<SE3d> T_ground_truth;  ///< T_target_source.
  bool truth_is_exact = false;         ///< Simulated: no check is needed.
  std::optional<SE3d> T_prior;         ///< The motion of the frame before, where it is known.
  SE3d T_initial;                      ///< Pose at u = 0, and where register starts.
  Features features;                   ///< Of the source, where a metric needs them.
  std::string title;                   ///< For figures: "KITTI 00, scan 95 to 94".
};

/// Refuses what can be seen to be wrong before any file is read, also where one of the metrics
/// cannot be had of voxels, or a ground truth is needed and the input has none. Throws UsageError.
void CheckPairFlags(const std::vector<std::string>& metrics, bool needs_ground_truth);

/// Simulates the pair of --scene --seed, or reads that of --kitti_root --sequence --frame or of
/// --source --target --ground_truth; takes centroids for points under --voxel_m; estimates normals
/// and extracts features where one of the metrics needs them, prints what was read and dropped, and
/// records inputs and timings.
ScanPair LoadPair(const std::vector<std::string>& metrics, Manifest* manifest);

/// Checks the pair's ground truth, prints how far point-to-plane moves from it and records that. A
/// truth that is exact stays what it is: there an offset is the metric's.
/// Where the check has no answer: throws ComputationError if it is `needed`, else says so and
/// returns nothing.
std::optional<GroundTruthCheck> GroundTruthCheckOf(const ScanPair& pair, bool needed,
                                                   Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_PAIR_H_
