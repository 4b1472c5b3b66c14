// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_DOF_MASK_H_
#define ICPSCAPE_RESIDUALS_DOF_MASK_H_

#include <array>

namespace icpscape {

/// Which of the six directions of a step xi = [omega; v] are free; T <- T Exp(xi), so that they are
/// those of the moving body: rotations about its x, y and z axis, then translations along them.
using DofMask = std::array<bool, 6>;

inline constexpr DofMask kAllDof = {true, true, true, true, true, true};
/// A vehicle on the ground: x, y and yaw.
inline constexpr DofMask kPlanarDof = {false, false, true, true, true, false};

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_DOF_MASK_H_
