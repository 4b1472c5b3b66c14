// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COMMON_VEHICLE_H_
#define ICPSCAPE_SRC_COMMON_VEHICLE_H_

namespace icpscape {

/// How far the sensor sits in front of the rear axle: in KITTI's official poses the point that
/// turns without side slip lies 0.61 to 0.68 m behind the lidar (sequences 05 to 08).
inline constexpr double kSensorAheadOfRearAxle_m = 0.65;

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COMMON_VEHICLE_H_
