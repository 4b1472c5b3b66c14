// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PREPARATION_DESKEW_H_
#define ICPSCAPE_SRC_PREPARATION_DESKEW_H_

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// The turn of the lidar that a scan comes from, by the times of its points (s).
struct Sweep {
  double first_s = 0;
  double last_s = 0;

  double Duration_s() const { return last_s - first_s; }
  /// The instant that the scan's pose belongs to: 0 where it lies within the sweep, else the
  /// middle. So points may count from an instant within their sweep, to which the scan's own time
  /// belongs (KITTI's scanner triggers when it looks forward); and where they count from any other
  /// start, no point is farther from its instant than half a turn.
  double Instant_s() const { return first_s < 0 && last_s > 0 ? 0 : (first_s + last_s) / 2; }
};

/// Throws InputError where a time is not finite. The cloud has times.
Sweep SweepOf(const PointCloud& cloud);

/// Moves what was measured at other instants into the lidar's frame at the scan's instant t_0,
///   p <- Exp((t - t_0) velocity) p,
/// for a lidar that moves with a constant body twist `velocity` = [omega; v] per second (rad/s,
/// m/s), as KISS-ICP [Vizzo et al. 2023, eq. 3] and CT-ICP [Dellenbach et al. 2022] do. Afterwards
/// all points belong to one instant, and the times are gone. Normals turn along. The result does
/// not depend on `threads`. Throws InputError where a time is not finite.
void Deskew(const Vec6& velocity, int threads, PointCloud* cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PREPARATION_DESKEW_H_
