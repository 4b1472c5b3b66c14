// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_ODOMETRY_H_
#define ICPSCAPE_APPS_FLAGS_ODOMETRY_H_

#include "icpscape/odometry/odometry.h"

namespace icpscape {

/// Gives flags the defaults that suit --mode and --metrics. What the command line gives stays.
void SetDefaultsOfMode();

/// All that an odometry is made of. Throws UsageError.
OdometryOptions OdometryFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_ODOMETRY_H_
