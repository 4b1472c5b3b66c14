// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_DATASET_H_
#define ICPSCAPE_SRC_IO_DATASET_H_

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// A folder in KITTI's layout to be filled with simulated scans:
///   ROOT/sequences/NAME/{velodyne/NNNNNN.bin, labels/NNNNNN.label, rings/NNNNNN.ring},
///   ROOT/sequences/NAME/{calib.txt, times.txt}, ROOT/poses/NAME.txt,
/// and, if asked for, ROOT/sequences/NAME/{times/NNNNNN.time, ply/NNNNNN.ply}.
struct DatasetOptions {
  std::filesystem::path root;
  std::string name;
  bool ply = false;
  bool point_times = false;  ///< Whether the points have times, which are written.
  /// All that the scans depend on, as text: the scans are kept while it stays the same.
  std::string parameters;
};

struct DatasetSummary {
  int simulated = 0;  ///< Scans written now, ...
  int kept = 0;       ///< ... and scans that were there already, whole.
};

/// Writes one scan per pose. ROOT/sequences/NAME/simulation.json records the parameters and the
/// SHA-256 of every file: scans that are there, unharmed and of the same parameters are kept, and a
/// run that was stopped is taken up. `scan(i)` simulates; `progress` (if any) is called with the
/// number of scans done. Throws InputError where the folder cannot be written, or holds scans that
/// are not ours.
DatasetSummary WriteDataset(const DatasetOptions& options, const std::vector<SE3d>& T_world_lidar,
                            const std::function<PointCloud(int)>& scan,
                            const std::function<void(int)>& progress = nullptr);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_DATASET_H_
