// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_TOWN_H_
#define ICPSCAPE_SRC_SIMULATION_TOWN_H_

#include <cstdint>
#include <vector>

#include "icpscape/simulation/street_network.h"
#include "icpscape/simulation/world.h"

namespace icpscape {

/// Lines the streets with houses, front gardens behind hedges, fences and walls, trees, lamps,
/// signs, bins and parked cars. `route` (m) is where the lidar drives: nothing stands within the
/// width of its car and a margin. The same streets and key give the same town.
World MakeTown(const StreetNetwork& streets, const std::vector<Vec2>& route, std::uint64_t key);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_TOWN_H_
