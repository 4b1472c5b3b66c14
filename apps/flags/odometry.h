// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_ODOMETRY_H_
#define ICPSCAPE_APPS_FLAGS_ODOMETRY_H_

#include "src/odometry/odometry.h"

namespace icpscape {

/// Sets the flags that were not given to what suits --mode and --metrics; then they are recorded as
/// if they had been.
void SetDefaultsOfMode();

/// All that an odometry is made of. Throws UsageError.
OdometryOptions OdometryFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_ODOMETRY_H_
