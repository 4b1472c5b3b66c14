// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_LIDAR_H_
#define ICPSCAPE_APPS_FLAGS_LIDAR_H_

#include <cstdint>
#include <string>

#include "icpscape/simulation/lidar.h"

namespace icpscape {

/// The simulated lidar of --azimuth_step_deg, --range_noise_m, --ring_bias_m, --dropout and
/// --skewed. Throws
/// UsageError.
LidarOptions LidarFromFlags();

/// --seed. Throws UsageError for a negative one.
std::uint64_t SeedFromFlags();

/// All of these flags with their values, as text: simulated scans that differ differ in it.
std::string LidarText();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_LIDAR_H_
