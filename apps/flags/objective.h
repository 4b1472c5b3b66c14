// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_OBJECTIVE_H_
#define ICPSCAPE_APPS_FLAGS_OBJECTIVE_H_

#include <string>
#include <vector>

#include "src/cloud/features.h"
#include "src/objective/objective_set.h"

namespace icpscape {

/// --metrics, checked against the registry. Throws UsageError.
std::vector<std::string> MetricsFromFlags();

/// Matching, rejection, fits and loss. Throws UsageError.
ObjectiveSetOptions ObjectiveSetFromFlags();

/// Which points are edges and which are planar. Throws UsageError.
FeatureOptions FeaturesFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_OBJECTIVE_H_
