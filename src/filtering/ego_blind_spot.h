// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_FILTERING_EGO_BLIND_SPOT_H_
#define ICPSCAPE_SRC_FILTERING_EGO_BLIND_SPOT_H_

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/filtering/kept_points.h"

namespace icpscape {

/// What the paper takes on KITTI, for both functions below [paper sec. 4.2].
inline constexpr double kEgoBlindSpotRadius_m = 5;

/// Drops the points within a horizontal circle about their sensor (PointCloud::sensor, at the
/// origin by default), x^2 + y^2 <= r^2 there: KITTI's own blind spot is not circular, so the paper
/// first makes one that is [paper sec. 4.2]. Throws UsageError unless radius_m is a length above 0.
KeptPoints ArtificialBlindSpots(const PointCloud& source, const PointCloud& target,
                                double radius_m);

/// The ego blind spot filter [paper sec. 2.6]: drops the points of each scan that lie in the other
/// scan's blind spot, a vertical cylinder of radius r about the other sensor, since they can have
/// no correspondence there. With the sensors s_p and s_q of source and target, t = T_target_source
/// s_p and t' = T_target_source^-1 s_q,
///   q is dropped where (q_x - t_x)^2 + (q_y - t_y)^2 <= r^2,
///   p is dropped where (p_x - t'_x)^2 + (p_y - t'_y)^2 <= r^2.
/// The estimate is usually the predicted pose. Throws UsageError unless radius_m is a length above
/// 0.
KeptPoints EgoBlindSpotFilter(const PointCloud& source, const PointCloud& target,
                              const SE3d& T_target_source_estimate, double radius_m);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_FILTERING_EGO_BLIND_SPOT_H_
