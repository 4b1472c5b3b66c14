// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_MATCHING_H_
#define ICPSCAPE_APPS_FLAGS_MATCHING_H_

#include "icpscape/matching/closest_point_matcher.h"

namespace icpscape {

/// Which pairs are rejected. Throws UsageError.
MatchingOptions MatchingFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_MATCHING_H_
