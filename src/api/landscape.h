// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_API_LANDSCAPE_H_
#define ICPSCAPE_SRC_API_LANDSCAPE_H_

#include <vector>

#include "icpscape/api/pair.h"
#include "icpscape/landscape/curve.h"

namespace icpscape {

/// Options of Landscape.
struct LandscapeOptions : PairOptions {
  /// By default point_to_point, point_to_plane and symmetric.
  LandscapeOptions();

  PathKind path = PathKind::kLerpSlerp;
  /// Interval of u, number of poses, and whether pairs are frozen. Its `threads` is not used.
  CurveOptions curve;
};

/// Objective functions along a path of poses.
struct LandscapeResult {
  /// One for each metric, in their order. Curve::Minimum gives the lowest point.
  std::vector<Curve> curves;
  /// Between the frames of the clouds, less their origins where they lie far out (see
  /// PointCloud::origin).
  Path path;
  PairOrigins origins;

  /// The pose of each point in the coordinates of the user: u = 0 is T_initial, u = 1 the
  /// reference.
  SE3d Pose(double u) const { return origins.ToUser(path.Pose(u)); }
};

/// Evaluates the objective functions of two clouds along a path of poses T_u through T_initial
/// (u = 0) and T_reference (u = 1), and draws nothing. At each pose every point is matched anew, as
/// ICP does, and
///   rmse(u) = sqrt(eps(T_u) / n(T_u))
/// with eps as the paper prints it (sum |r|^2 for points, planes and symmetric metrics) and n the
/// number of pairs; CurvePoint has the cost that Register minimises, and slopes d rmse / du.
///
/// The path is that of PointCloud::sensor of the source. T_reference is the motion that is believed
/// to be true: p_target = T_reference * p_source. Clouds are in metres, each in its own frame; see
/// Register.
///
/// icpscape-landscape with the same options has the same bits in curves.csv.
///
/// Throws what Register throws for options and clouds, and ComputationError where a pose leaves a
/// metric without pairs.
LandscapeResult Landscape(PointCloud source, PointCloud target, const SE3d& T_reference,
                          const LandscapeOptions& options = {});

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_API_LANDSCAPE_H_
