// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_STARTS_H_
#define ICPSCAPE_APPS_FLAGS_STARTS_H_

#include "icpscape/minimizer/random_starts.h"

namespace icpscape {

/// How far random starts lie from the pose about which they are drawn: --start_m and --start_deg;
/// --seed. Count and minimiser are left to the caller. Throws UsageError.
RandomStartOptions StartsFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_STARTS_H_
