// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_SCENES_H_
#define ICPSCAPE_SRC_SIMULATION_SCENES_H_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "icpscape/simulation/world.h"

namespace icpscape {

/// The paper's four scenes, as worlds for the simulated lidar: straight_street, right_turn,
/// highway, highway_overtaking. The lidar moves as KITTI's did at the paper's frames.
std::vector<std::string> SceneNames();

/// Throws UsageError naming the scenes there are.
void CheckSceneName(const std::string& name);

/// Scans of a scene: the frames N - 2, N - 1 (the target) and N (the source).
constexpr int kSceneScans = 3;

/// A world and the lidar's way through it.
struct Scene {
  World world;
  std::string paper_frame;  ///< "00/1500": sequence and frame whose motion this is.
  std::array<SE3d, kSceneScans> T_world_lidar;  ///< At -0.1, 0 and 0.1 s.

  SE3d T_target_source() const { return T_world_lidar[1].Inverse() * T_world_lidar[2]; }
};

/// The scene of that name; the same name and seed give the same scene on every machine.
Scene MakeScene(const std::string& name, std::uint64_t seed);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_SCENES_H_
