// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_LANDSCAPE_PATH_H_
#define ICPSCAPE_SRC_LANDSCAPE_PATH_H_

#include <string>
#include <vector>

#include "residuals/lie.h"

namespace icpscape {

enum class PathKind {
  /// Translation and rotation interpolated separately, as printed [paper sec. 3.1]:
  ///   t_u = (1 - u) t_0 + u t_1,   R_u = R_0 Exp(u Log(R_0^T R_1)).
  kLerpSlerp,
  /// The geodesic of SE(3), motion with a constant body twist: T_u = T_0 Exp(u Log(T_0^-1 T_1)).
  kGeodesic,
};

/// Names in the order of the enum: lerp_slerp, geodesic. Throws UsageError for others.
PathKind PathKindFromName(const std::string& name);
const std::vector<std::string>& PathKindNames();

/// A path of poses T_u through T_0 (u = 0) and T_1 (u = 1), defined for every real u: outside
/// [0, 1] it extrapolates. The shorter way round is taken; R_0^T R_1 must turn by less than pi.
class Path {
 public:
  Path(const SE3d& T_0, const SE3d& T_1, PathKind kind);

  SE3d Pose(double u) const;

  /// xi = [omega; v] with dT_u/du = T_u hat(xi): rad and m per unit of u.
  Vec6 BodyTwist(double u) const;

 private:
  PathKind kind_;
  SE3d T_0_;
  SE3d T_1_;
  Vec6 twist_;  // Log(T_0^-1 T_1)
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_LANDSCAPE_PATH_H_
