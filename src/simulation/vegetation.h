// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_VEGETATION_H_
#define ICPSCAPE_SRC_SIMULATION_VEGETATION_H_

#include <cstdint>

#include "icpscape/simulation/mesh.h"
#include "icpscape/simulation/random.h"

namespace icpscape {

/// A broad-leaved tree of that height at `foot`: trunk, boughs, and a crown of leaf clusters
/// through which some rays pass.
void AddTree(const Vec3& foot, double height_m, std::uint16_t instance, Random* random, Mesh* mesh);

/// A bush: leaf clusters in a flattened ball on the ground.
void AddBush(const Vec3& foot, double radius_m, std::uint16_t instance, Random* random, Mesh* mesh);

/// A clipped hedge from a to b (on the ground), its faces rough by some centimetres.
void AddHedge(const Vec3& a, const Vec3& b, double thickness_m, double height_m,
              std::uint16_t instance, std::uint64_t key, Mesh* mesh);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_VEGETATION_H_
