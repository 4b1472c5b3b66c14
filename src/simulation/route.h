// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_ROUTE_H_
#define ICPSCAPE_SRC_SIMULATION_ROUTE_H_

#include <vector>

#include "icpscape/residuals/lie.h"

namespace icpscape {

/// A drive for MakeDrive that needs no data: poses of the lidar, ten a second, of a car that sets
/// off, turns right and left at two crossings and stops, 228 m on. The rear axle follows the road's
/// middle line (straights and arcs of 9 m), at up to 10 m/s, 4 m/s in the turns and 2 m/s^2; the
/// lidar sits ahead of it, as in KITTI (see vehicle.h).
std::vector<SE3d> TownRoute();

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_ROUTE_H_
