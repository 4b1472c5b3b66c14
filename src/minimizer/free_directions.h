// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MINIMIZER_FREE_DIRECTIONS_H_
#define ICPSCAPE_SRC_MINIMIZER_FREE_DIRECTIONS_H_

#include "icpscape/residuals/dof_mask.h"
#include "icpscape/residuals/lie.h"

namespace icpscape {

/// Columns are directions in [L omega; v + omega x c]; see AboutPoint.
using Directions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// An orthonormal basis of the directions about a point in which the source may move, with the
/// matrix of AboutPoint.
Directions FreeDirections(const DofMask& free, const Mat6& about_point);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MINIMIZER_FREE_DIRECTIONS_H_
