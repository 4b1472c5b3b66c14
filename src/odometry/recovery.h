// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_RECOVERY_H_
#define ICPSCAPE_SRC_ODOMETRY_RECOVERY_H_

#include <optional>
#include <string>
#include <vector>

#include "icpscape/minimizer/registration.h"

namespace icpscape {

/// Where to start again a registration that lost its way: registers some 2000 source points by
/// Preset::kRobust from the predicted pose, and from the pose `T_still` of a sensor that did not
/// move, turned about its z axis by every multiple of 30 degrees; of the poses that these find,
/// the one whose pairs are shortest. Nothing where none finds a pose. Gate, loss and
/// re-association of the options do not count. The metrics are of closest points.
std::optional<SE3d> FindStart(const SearchableCloud& source, const SearchableCloud& target,
                              const std::vector<std::string>& metrics,
                              const std::vector<double>& weights, ObjectiveSetOptions objective,
                              MinimizerOptions minimizer, const SE3d& T_predicted,
                              const SE3d& T_still);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_RECOVERY_H_
