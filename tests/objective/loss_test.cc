// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/loss.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

double Rho(const char* name, double scale_m, double residual_m) {
  double rho[3];
  MakeLoss(name, scale_m)->Evaluate(residual_m * residual_m, rho);
  return rho[0];
}

// Each loss by its formula, at a scale and at residuals that are not 1: a scale that is squared
// once too often, or not at all, shows.
TEST(Loss, ValuesByTheFormulas) {
  for (const double a : {0.5, 3.0}) {
    for (const double r : {0.4 * a, 0.9 * a, 4 * a}) {
      const double s = r * r, a2 = a * a;
      EXPECT_NEAR(Rho("huber", a, r), r <= a ? s : 2 * a * r - a2, 1e-12);
      EXPECT_NEAR(Rho("soft_l_one", a, r), 2 * a2 * (std::sqrt(1 + s / a2) - 1), 1e-12);
      EXPECT_NEAR(Rho("cauchy", a, r), a2 * std::log(1 + s / a2), 1e-12);
      EXPECT_NEAR(Rho("arctan", a, r), a2 * std::atan(s / a2), 1e-12);
      EXPECT_NEAR(Rho("tukey", a, r), a2 / 3 * (r <= a ? 1 - std::pow(1 - s / a2, 3) : 1), 1e-12);
      const double width = 0.1 * a2;  // Of the tolerant loss, whose step is at s = a^2.
      EXPECT_NEAR(
          Rho("tolerant", a, r),
          width * (std::log1p(std::exp((s - a2) / width)) - std::log1p(std::exp(-a2 / width))),
          1e-12);
    }
  }
}

TEST(Loss, ScalesFromAMicrometreToAThousandKilometres) {
  for (const std::string& name : LossNames()) {
    EXPECT_NO_THROW(MakeLoss(name, 1e-6));
    EXPECT_NO_THROW(MakeLoss(name, 1e6));
    EXPECT_THROW(MakeLoss(name, 0.99e-6), UsageError);
    EXPECT_THROW(MakeLoss(name, 1.01e6), UsageError);
    EXPECT_THROW(MakeLoss(name, 0), UsageError);
    EXPECT_THROW(MakeLoss(name, NAN), UsageError);
  }
}

TEST(Loss, UnknownNamesAreRefusedAndNoneIsNull) {
  EXPECT_THROW(MakeLoss("hubert", 1), UsageError);
  EXPECT_EQ(MakeLoss("none", 1), nullptr);
}

}  // namespace
}  // namespace icpscape
