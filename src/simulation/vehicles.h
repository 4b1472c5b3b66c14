// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_VEHICLES_H_
#define ICPSCAPE_SRC_SIMULATION_VEHICLES_H_

#include <cstdint>

#include "icpscape/simulation/mesh.h"
#include "icpscape/simulation/random.h"

namespace icpscape {

/// A car, about 4.2 to 4.8 m long: saloon, estate or hatchback, with bonnet, windows, wheels in
/// arches and mirrors. Frame: x forward, z up, centre of the outline at the origin, wheels at z =
/// 0.
Mesh MakeCar(Label label, std::uint16_t instance, Random* random);

/// A tractor with a 13.6 m tarpaulin semi-trailer, 16.5 m long, 2.55 m wide and 4 m high, the most
/// that Directive 96/53/EC allows. Frame as above.
Mesh MakeLorry(Label label, std::uint16_t instance);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_VEHICLES_H_
