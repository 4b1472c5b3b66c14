// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_PAIR_FLAGS_H_
#define ICPSCAPE_APPS_PAIR_FLAGS_H_

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/cloud/point_cloud.h"
#include "src/io/manifest.h"
#include "src/objective/objective.h"

namespace icpscape {

/// Two scans to register, as the flags of landscape and register name them.
struct ScanPair {
  PointCloud source;
  PointCloud target;
  std::optional<SE3d> T_ground_truth;  ///< T_target_source.
  std::optional<SE3d> T_prior;         ///< The motion of the frame before, where it is known.
  std::string title;                   ///< For figures: "KITTI 00, scan 95 to 94".
};

/// Refuses what can be seen to be wrong before any file is read. Throws UsageError.
void CheckPairFlags();

/// Simulates the pair of --scene --seed, or reads that of --kitti_root --sequence --frame or of
/// --source --target --ground_truth; estimates normals where one of the metrics
/// needs them, prints what was read and dropped, and records inputs and timings.
ScanPair LoadPair(const std::vector<std::string>& metrics, Manifest* manifest);

/// --metrics, checked against the registry. Throws UsageError.
std::vector<std::string> MetricsFromFlags();

/// The loss of --loss and --loss_scale_m; null for none.
std::shared_ptr<const ceres::LossFunction> LossFromFlags();

MatchingOptions MatchingFromFlags();
int ThreadsFromFlags();
/// --out, created and proved writable. Throws InputError.
std::filesystem::path OutputFolder();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_PAIR_FLAGS_H_
