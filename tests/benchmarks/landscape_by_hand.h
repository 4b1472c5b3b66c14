// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_LANDSCAPE_BY_HAND_H_
#define ICPSCAPE_TESTS_BENCHMARKS_LANDSCAPE_BY_HAND_H_

#include <array>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// RMSEs of point_to_point, point_to_plane and symmetric at each pose, as a careful user of
/// nanoflann writes it: one tree, one search per point and pose for all metrics, poses in parallel.
/// Values only, no derivatives.
std::vector<std::array<double, 3>> LandscapeByHand(const PointCloud& source,
                                                   const PointCloud& target,
                                                   const std::vector<SE3d>& poses, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_LANDSCAPE_BY_HAND_H_
