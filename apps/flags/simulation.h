// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_SIMULATION_H_
#define ICPSCAPE_APPS_FLAGS_SIMULATION_H_

#include <filesystem>
#include <string>
#include <vector>

#include "icpscape/io/sequences.h"

namespace icpscape {

/// What icpscape-simulate is to write: scenes, or one drive.
struct SimulationPlan {
  std::vector<std::string> scenes;   ///< None for a drive.
  std::string drive;                 ///< Name of the drive: a sequence of KITTI, or "town".
  std::filesystem::path kitti_root;  ///< Of the drive's poses; empty for the town.
  FrameRange frames;                 ///< Of the drive.
  bool ply = false;                  ///< Whether each scan is written as PLY as well.
};

/// --scene, or --kitti_root and --sequence; --frames, --ply. Throws UsageError.
SimulationPlan SimulationFromFlags();

/// T_world_lidar of the plan's drive: those of KITTI's files, or of the route through the town.
/// Throws InputError where the files have none.
std::vector<SE3d> PosesOfDrive(const SimulationPlan& plan);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_SIMULATION_H_
