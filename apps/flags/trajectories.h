// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_TRAJECTORIES_H_
#define ICPSCAPE_APPS_FLAGS_TRAJECTORIES_H_

#include <filesystem>
#include <string>
#include <vector>

#include "icpscape/io/sequences.h"

namespace icpscape {

/// Which trajectory is compared with which truth.
struct TrajectoryFiles {
  std::string name;  ///< What tables call it.
  std::filesystem::path estimate, truth;
  std::filesystem::path times;        ///< Of the truth's poses; empty where no file is named.
  std::filesystem::path calibration;  ///< Empty where none is given.
};

/// Those of --estimate and --ground_truth, or --kitti_root and --sequences; --calib. Throws
/// UsageError.
std::vector<TrajectoryFiles> TrajectoriesFromFlags();

/// Frames of the truth that were estimated: --frames. Throws UsageError.
FrameRange TruthFramesFromFlags();

/// --max_time_difference_s and --rpe_frames. Throw UsageError.
double MaxTimeDifferenceFromFlags();
int RpeFramesFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_TRAJECTORIES_H_
