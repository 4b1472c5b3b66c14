// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PREPARATION_ELEVATION_H_
#define ICPSCAPE_SRC_PREPARATION_ELEVATION_H_

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Turns every point about the horizontal axis through the sensor across its line of sight by this
/// angle (upwards if positive): users of KITTI correct the HDL-64's elevation calibration so, by
/// about 0.2 degrees.
void CorrectElevation(double angle_deg, PointCloud* cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PREPARATION_ELEVATION_H_
