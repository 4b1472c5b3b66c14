// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_LOCAL_FIT_H_
#define ICPSCAPE_APPS_FLAGS_LOCAL_FIT_H_

#include "icpscape/matching/local_fit_matcher.h"

namespace icpscape {

/// The line or patch through the neighbours of a point. Throws UsageError.
LocalFitOptions LocalFitFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_LOCAL_FIT_H_
