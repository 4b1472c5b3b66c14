// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_EVALUATION_H_
#define ICPSCAPE_SRC_OBJECTIVE_EVALUATION_H_

#include "icpscape/objective/block_kernels.h"
#include "icpscape/residuals/normal_equations.h"

namespace icpscape {

/// An objective's value and derivatives at one pose.
struct Evaluation {
  /// cost = 1/2 sum rho(|r|^2), gradient, Gauss-Newton Hessian and n: what the solver minimises.
  NormalEquations sums;
  /// sum |r|^2, whatever the loss (m^2).
  double sum_squared = 0;
  /// The paper's eps(T), as printed; it knows no loss.
  double epsilon = 0;
  /// d epsilon / d xi, T <- T Exp([omega; v]).
  Vec6 epsilon_gradient = Vec6::Zero();

  /// Adds one block's sums.
  void Add(const BlockSums& sums);
  /// Adds weight times the other; n counts whole.
  void Add(const Evaluation& other, double weight);

  long n() const { return sums.num_correspondences; }
  /// RMSE(eps) = sqrt(eps / n) [paper sec. 4]; NaN where n = 0.
  double Rmse() const;
  /// sqrt(sum |r|^2 / n); NaN where n = 0.
  double RmsResidual() const;
  /// d Rmse / du for a motion with body twist xi = dT/du.
  double RmseSlope(const Vec6& body_twist) const;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_EVALUATION_H_
