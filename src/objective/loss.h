// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_LOSS_H_
#define ICPSCAPE_SRC_OBJECTIVE_LOSS_H_

#include <memory>
#include <string>
#include <vector>

namespace ceres {
class LossFunction;
}

namespace icpscape {

/// Names of the losses, in the order of the documentation:
/// none, huber, soft_l_one, cauchy, arctan, tukey, tolerant.
const std::vector<std::string>& LossNames();

/// The Ceres loss rho of that name; null for "none". rho acts on |r|^2, `scale_m` on |r| (m): where
/// the loss starts to bend (for tolerant: where it starts to count, with a width of a tenth of it).
/// Throws UsageError for an unknown name or a scale outside 1e-6 to 1e6 m.
std::shared_ptr<const ceres::LossFunction> MakeLoss(const std::string& name, double scale_m);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_LOSS_H_
