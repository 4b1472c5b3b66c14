// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_OBJECTIVE_H_
#define ICPSCAPE_APPS_FLAGS_OBJECTIVE_H_

#include <string>
#include <vector>

#include "apps/flags/features.h"
#include "icpscape/objective/objective_set.h"

namespace icpscape {

/// --metrics, checked against the registry. Throws UsageError.
std::vector<std::string> MetricsFromFlags();

/// Matching, rejection, lines and patches, and loss. Throws UsageError.
ObjectiveSetOptions ObjectiveSetFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_OBJECTIVE_H_
