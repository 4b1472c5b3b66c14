// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_SENSOR_H_
#define ICPSCAPE_APPS_FLAGS_SENSOR_H_

#include <optional>

#include "icpscape/cloud/scan_sequence.h"

namespace icpscape {

/// --sensor_origin, in the coordinates of the user's files; nothing where it is not given. Throws
/// UsageError.
std::optional<Vec3> SensorFromFlags();

/// Where --sensor_origin is given, all scans that are read from now on have their sensor there.
void PlaceSensors(ScanSequence* sequence);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_SENSOR_H_
