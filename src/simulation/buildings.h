// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_BUILDINGS_H_
#define ICPSCAPE_SRC_SIMULATION_BUILDINGS_H_

#include <cstdint>

#include "icpscape/simulation/mesh.h"
#include "icpscape/simulation/random.h"

namespace icpscape {

/// A house on a rectangle. Frame: the front lies on y = 0 and looks towards -y, from x = 0 to the
/// width; the house reaches back to y = depth.
struct House {
  double width_m = 12;
  double depth_m = 10;
  int floors = 3;
};

/// Walls with plinth, windows in reveals, doors in recesses, bay windows, balconies, downpipes and
/// a gabled roof. Floors are 3 m high.
void AddHouse(const House& house, const SE3d& T_mesh_house, std::uint16_t instance, Random* random,
              Mesh* mesh);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_BUILDINGS_H_
