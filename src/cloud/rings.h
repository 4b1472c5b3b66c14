// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_RINGS_H_
#define ICPSCAPE_SRC_CLOUD_RINGS_H_

#include <cstdint>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Recovers the scan rings of a KITTI scan and returns their number. A cloud that already has rings
/// keeps them.
///
/// KITTI's HDL-64 files carry no ring number, but their points come ring by ring, the uppermost
/// first, and within a ring by azimuth atan2(y, x) about PointCloud::sensor, counter-clockwise from
/// the x axis: a ring begins where the azimuth leaves the fourth quadrant for the first, or else
/// falls back by more than 20 degrees. Smaller steps back are left by de-skewing (up to 6 degrees
/// in sequence 00) and stay in the ring, across the seam at the x axis too.
///
/// Limits: the cloud must be in file order (any subset in that order will do). A ring without a
/// single point cannot be seen, and the rings below it are numbered one too low. Where a ring's
/// last point and the next ring's first are all that is left around more than half a turn, the two
/// can merge. Throws InputError where the order is plainly another: one ring, or more than 128.
int RecoverRings(PointCloud* cloud);

/// The points of each ring, in the order of the cloud: entry r holds the indices i with
/// cloud.ring[i] == r. Throws InputError where the cloud has no rings or a ring is negative.
std::vector<std::vector<std::int32_t>> PointsByRing(const PointCloud& cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_RINGS_H_
