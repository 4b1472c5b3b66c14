// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_NORMAL_EQUATIONS_H_
#define ICPSCAPE_RESIDUALS_NORMAL_EQUATIONS_H_

#include "lie.h"

namespace icpscape {

/// Sums over correspondences of what a Gauss-Newton step needs: for solvers of your own;
/// SquareRootCost hands these 28 numbers to Ceres.
///   cost     = 1/2 sum rho(|r|^2)           (m^2 for metric residuals)
///   gradient = sum rho' J^T r               d cost / d xi, T <- T Exp([omega; v])
///   hessian  = sum rho' J^T J               Gauss-Newton, as Ceres scales it where rho'' <= 0
/// Only the upper triangle of `hessian` is summed; Hessian() gives the full matrix.
struct NormalEquations {
  Mat6 hessian = Mat6::Zero();
  Vec6 gradient = Vec6::Zero();
  double cost = 0;
  long num_correspondences = 0;
  /// True once a loss curved upwards (rho'' > 0, as TolerantLoss does): Ceres then corrects the
  /// residuals in a way that these sums do not follow.
  bool upward_loss = false;

  Mat6 Hessian() const { return hessian.selfadjointView<Eigen::Upper>(); }

  /// Adds one residual (kDim rows) and its Jacobian (kDim x 6).
  template <class Residual, class Jacobian>
  void Add(const Residual& r, const Jacobian& J) {
    AddScaled(r, J, 1.0);
    cost += 0.5 * r.squaredNorm();
    ++num_correspondences;
  }

  /// The same under a loss: rho = {rho(s), rho'(s), rho''(s)} at s = |r|^2, as
  /// ceres::LossFunction::Evaluate writes it.
  template <class Residual, class Jacobian>
  void Add(const Residual& r, const Jacobian& J, const double rho[3]) {
    AddScaled(r, J, rho[1]);
    cost += 0.5 * rho[0];
    upward_loss |= rho[2] > 0;
    ++num_correspondences;
  }

  /// Multiplies the objective by a weight (n stays).
  void Scale(double weight) {
    hessian *= weight;
    gradient *= weight;
    cost *= weight;
  }

  NormalEquations& operator+=(const NormalEquations& other) {
    hessian += other.hessian;
    gradient += other.gradient;
    cost += other.cost;
    num_correspondences += other.num_correspondences;
    upward_loss |= other.upward_loss;
    return *this;
  }

 private:
  template <class Residual, class Jacobian>
  void AddScaled(const Residual& r, const Jacobian& J, double weight) {
    // Unrolled by hand: Eigen's rank update of a triangle costs twice as much at this size.
    for (int row = 0; row < J.rows(); ++row) {
      for (int i = 0; i < 6; ++i) {
        const double wj = weight * J(row, i);
        gradient[i] += wj * r[row];
        for (int j = i; j < 6; ++j) {
          hessian(i, j) += wj * J(row, j);
        }
      }
    }
  }
};

/// Adds one correspondence's metric at T, without loss.
template <class Metric>
void Accumulate(const Metric& metric, const SE3d& T_target_source, NormalEquations* sums) {
  sums->Add(metric.Residual(T_target_source), metric.Jacobian(T_target_source));
}

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_NORMAL_EQUATIONS_H_
