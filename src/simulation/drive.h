// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_DRIVE_H_
#define ICPSCAPE_SRC_SIMULATION_DRIVE_H_

#include <cstdint>
#include <vector>

#include "icpscape/simulation/street_network.h"
#include "icpscape/simulation/world.h"

namespace icpscape {

/// A drive through a town built for it.
struct Drive {
  World world;
  std::vector<SE3d> T_world_lidar;  ///< The truth: one pose per scan.
};

/// Poses on level ground: x, y and yaw of the given ones, at the lidar's height. This projection is
/// the drive, and its truth; height and tilt of the original are gone.
std::vector<SE3d> ProjectToGround(const std::vector<SE3d>& T_world_lidar);

/// The streets under a route: straight ones along it, with the route on their right lane, which go
/// on as side roads where the route turns off. Where the route comes back to a street it stays on
/// that street: the world is the same.
std::vector<Street> StreetsAlong(const std::vector<Vec2>& route);

/// The drive of these lidar poses (any frame with z up at the first), and its town. The whole route
/// makes the town; the same route and key make the same one.
Drive MakeDrive(const std::vector<SE3d>& T_world_lidar, std::uint64_t key);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_DRIVE_H_
