// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_MONTE_CARLO_H_
#define ICPSCAPE_APPS_FLAGS_MONTE_CARLO_H_

#include "icpscape/monte_carlo/monte_carlo.h"

namespace icpscape {

/// The Monte-Carlo experiment of --scene, --draws and --sensor, with the options of all that a draw
/// goes through. `draws` is 0 without --scene. Throws UsageError, also for flags that draws do not
/// apply.
MonteCarloOptions MonteCarloFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_MONTE_CARLO_H_
