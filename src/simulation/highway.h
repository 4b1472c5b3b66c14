// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_HIGHWAY_H_
#define ICPSCAPE_SRC_SIMULATION_HIGHWAY_H_

#include <cstdint>

#include "icpscape/simulation/world.h"

namespace icpscape {

/// The slope of the carriageway across, down to the right.
constexpr double kHighwayCrossfall = 0.025;

/// A straight motorway along x: three lanes of 3.75 m a side with the lidar's lane, the middle one,
/// about y = 0 (RAA, cross-section RQ 36), hard shoulders, guard rails, a planted median, grass
/// embankments with bushes, and few trees, signs and delineators. 300 m of it.
World MakeHighway(std::uint64_t key);

/// The traffic of the overtaking scene at time 0. Left of the lidar a car passes, 6 m/s faster
/// than the lidar's own `speed_m_s`: 116 km/h to its 95. Right of it a lorry drives at 25 m/s, to
/// which Directive 92/6/EEC limits it: the lidar's car overtakes it slowly.
void AddTraffic(double speed_m_s, std::uint64_t key, World* world);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_HIGHWAY_H_
