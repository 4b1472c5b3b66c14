// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_WORLD_H_
#define ICPSCAPE_SRC_SIMULATION_WORLD_H_

#include <vector>

#include "icpscape/simulation/mesh.h"

namespace icpscape {

/// Something that moves in a straight line: where it is at time t is
/// Translate(t * velocity_world_m_s) * T_world_object.
struct MovingObject {
  Mesh mesh;            ///< In its own frame: x forward, z up, on the ground at z = 0.
  SE3d T_world_object;  ///< At time 0.
  Vec3 velocity_world_m_s = Vec3::Zero();
};

/// Everything a lidar can see. World frame: z up, the road about z = 0; metres.
struct World {
  Mesh standing;
  std::vector<MovingObject> moving;

  /// The number of the next object, for Surface::instance.
  std::uint16_t NextInstance() {
    next_instance_ = static_cast<std::uint16_t>(next_instance_ % 32767 + 1);
    return next_instance_;
  }

  /// All that moves, where it is at that time.
  Mesh MovingAt(double time_s) const {
    Mesh mesh;
    for (const MovingObject& object : moving) {
      mesh.Append(object.mesh, SE3d(Mat3::Identity(), time_s * object.velocity_world_m_s) *
                                   object.T_world_object);
    }
    return mesh;
  }

 private:
  std::uint16_t next_instance_ = 0;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_WORLD_H_
