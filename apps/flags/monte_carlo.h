// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_MONTE_CARLO_H_
#define ICPSCAPE_APPS_FLAGS_MONTE_CARLO_H_

#include "icpscape/monte_carlo/monte_carlo.h"

namespace icpscape {

/// The Monte-Carlo experiment of --scene, --draws and --sensor, with the options of all that a draw
/// goes through. `draws` is 0 where there is no --scene, or none are asked for. Throws UsageError,
/// also for flags that draws do not know.
MonteCarloOptions MonteCarloFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_MONTE_CARLO_H_
