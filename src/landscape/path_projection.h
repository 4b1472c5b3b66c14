// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_LANDSCAPE_PATH_PROJECTION_H_
#define ICPSCAPE_SRC_LANDSCAPE_PATH_PROJECTION_H_

#include "icpscape/landscape/path.h"

namespace icpscape {

/// The place of a pose on a path, for plots, and its distance from the path: iterates of ICP
/// usually lie beside the path.
struct PathProjection {
  double u = 0;             ///< Of the nearest pose T_u.
  double off_path_m = 0;    ///< |t - t_u|, t being the place of the sensor; see Path.
  double off_path_rad = 0;  ///< angle(R_u^T R).
};

/// The u in [u_min, u_max] whose T_u is nearest to T, by
///   d(u)^2 = |t - t_u|^2 + (L angle(R_u^T R))^2,
/// L being the `rotation_length_m` at which a rotation counts as a displacement. Beyond the ends of
/// the interval that is the end itself. Among equals the smallest u. Found by sampling the interval
/// and zooming in about the least sample: exact to rounding for poses on the path. Beside it d is
/// flat about its least value, and rounding hides where that is: u is off by some 1e-8 d over the
/// path's length per u. A dip of d narrower than a hundredth of the interval can be missed: such a
/// path turns by several radians within it.
PathProjection ProjectOntoPath(const Path& path, const SE3d& T, double u_min, double u_max,
                               double rotation_length_m);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_LANDSCAPE_PATH_PROJECTION_H_
