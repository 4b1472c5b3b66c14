// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/loss.h"

#include <ceres/loss_function.h>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {

const std::vector<std::string>& LossNames() {
  static const std::vector<std::string> names = {"none",   "huber", "soft_l_one", "cauchy",
                                                 "arctan", "tukey", "tolerant"};
  return names;
}

std::shared_ptr<const ceres::LossFunction> MakeLoss(const std::string& name, double scale_m) {
  if (!(scale_m >= 1e-6 && scale_m <= 1e6)) {
    throw UsageError("loss scale " + Number(scale_m) + " m: expected 1e-6 to 1e6.");
  }
  if (name == "none") {
    return nullptr;
  }
  if (name == "huber") {
    return std::make_shared<ceres::HuberLoss>(scale_m);
  }
  if (name == "soft_l_one") {
    return std::make_shared<ceres::SoftLOneLoss>(scale_m);
  }
  if (name == "cauchy") {
    return std::make_shared<ceres::CauchyLoss>(scale_m);
  }
  if (name == "arctan") {
    // Ceres' arctan loss saturates on |r|^2 itself: its scale is an area.
    return std::make_shared<ceres::ArctanLoss>(scale_m * scale_m);
  }
  if (name == "tukey") {
    return std::make_shared<ceres::TukeyLoss>(scale_m);
  }
  if (name == "tolerant") {
    return std::make_shared<ceres::TolerantLoss>(scale_m * scale_m, 0.1 * scale_m * scale_m);
  }
  throw UsageError("unknown loss \"" + name + "\": expected one of " + Join(LossNames()) + ".");
}

}  // namespace icpscape
