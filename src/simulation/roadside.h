// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_ROADSIDE_H_
#define ICPSCAPE_SRC_SIMULATION_ROADSIDE_H_

#include <cstdint>

#include "icpscape/simulation/mesh.h"

namespace icpscape {

/// A street lamp of 6 m whose arm points along yaw_rad.
void AddLamp(const Vec3& foot, double yaw_rad, std::uint16_t instance, Mesh* mesh);

/// A traffic sign on a 60 mm tube, plate from 2.2 m up, facing along yaw_rad; the key chooses
/// between round, triangular and rectangular.
void AddSign(const Vec3& foot, double yaw_rad, std::uint64_t key, std::uint16_t instance,
             Mesh* mesh);

/// Pickets of 8 cm every 13 cm on two rails.
void AddPicketFence(const Vec3& a, const Vec3& b, double height_m, std::uint16_t instance,
                    Mesh* mesh);

/// A masonry wall, 25 cm thick, with a coping and a pillar at each end.
void AddLowWall(const Vec3& a, const Vec3& b, double height_m, std::uint16_t instance, Mesh* mesh);

/// A steel guard rail from a to b, both on the ground: the W-shaped beam, 0.31 m high with its top
/// at 0.75 m, on posts every 2 m (RAL-RG 620, profile B). It faces left of the direction from a
/// to b.
void AddGuardRail(const Vec3& a, const Vec3& b, std::uint16_t instance, Mesh* mesh);

/// A delineator post at the edge of a highway, 1 m high.
void AddDelineator(const Vec3& foot, std::uint16_t instance, Mesh* mesh);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_ROADSIDE_H_
