// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_VERDICT_NAMED_DIRECTIONS_H_
#define ICPSCAPE_SRC_VERDICT_NAMED_DIRECTIONS_H_

#include <string>
#include <vector>

#include "icpscape/residuals/lie.h"

namespace icpscape {

/// A direction of a motion z = [L omega; v], omega a turn about the sensor's axes, v a shift along
/// them and L a lever arm, with a name: "along x", "yaw", "along (0.71, 0.71, 0.00)", "about (0.00,
/// 0.71, 0.71)".
struct NamedDirection {
  Vec6 direction;  ///< Unit vector z.
  std::string name;
};

/// Orthonormal directions that span the same subspace as the columns of `basis`, which are
/// orthonormal. Those that are axes come first and are named after them: the three that a plane
/// leaves free are yaw, along x and along y, however the basis is turned among them.
std::vector<NamedDirection> NameDirections(const Eigen::Matrix<double, 6, Eigen::Dynamic>& basis);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_VERDICT_NAMED_DIRECTIONS_H_
