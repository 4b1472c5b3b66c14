// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_PAIR_FILTERS_H_
#define ICPSCAPE_APPS_FLAGS_PAIR_FILTERS_H_

#include "apps/flags/pair.h"
#include "icpscape/io/manifest.h"

namespace icpscape {

/// Refuses flags that are wrong before any file is read. Throws UsageError.
void CheckFilterFlags();

/// The scans after the data filters of the flags, once, before anything else [the first stage
/// of the paper's chain], with the predicted pose of --filter_estimate. Normals and features were
/// computed before and stay with their points. Prints and records what is kept. Throws
/// ComputationError where nothing is.
PreparedPair FilterFromFlags(const PreparedPair& scans, const ScanPair& pair, Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_PAIR_FILTERS_H_
