// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_PRESET_H_
#define ICPSCAPE_APPS_FLAGS_PRESET_H_

#include "icpscape/minimizer/registration.h"

namespace icpscape {

/// --preset. Under robust the default of --normal_neighbors is kRobustNormalNeighbors: call this
/// before that flag is read. Throws UsageError for an unknown preset, and for flags that robust
/// sets by itself.
Preset PresetFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_PRESET_H_
