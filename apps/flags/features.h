// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_FEATURES_H_
#define ICPSCAPE_APPS_FLAGS_FEATURES_H_

#include "icpscape/cloud/features.h"

namespace icpscape {

/// Which points are edges and which are planar. Throws UsageError.
FeatureOptions FeaturesFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_FEATURES_H_
