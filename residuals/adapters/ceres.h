// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_ADAPTERS_CERES_H_
#define ICPSCAPE_RESIDUALS_ADAPTERS_CERES_H_

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "../dof_mask.h"
#include "../normal_equations.h"

namespace icpscape {

/// SE(3) over one block of seven doubles [qx qy qz qw tx ty tz], with the tangent and the
/// exponential of lie.h: Plus(x, xi) = x Exp(xi), Minus(y, x) = Log(x^-1 y).
///
/// Ceres' own quaternion manifolds are of no use here: their tangent is the half angle, on the
/// other side.
class SE3Manifold final : public ceres::Manifold {
 public:
  using PlusMatrix = Eigen::Matrix<double, 7, 6, Eigen::RowMajor>;
  using MinusMatrix = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }

  bool Plus(const double* x, const double* xi, double* x_plus_xi) const override {
    const SE3d T = SE3d::FromParameters(x) * SE3d::Exp(Eigen::Map<const Vec6>(xi));
    T.ToParameters(x_plus_xi);
    // Of the two quaternions of a rotation take the one on x's side: Plus must be continuous.
    Eigen::Map<Eigen::Vector4d> q(x_plus_xi);
    if (q.dot(Eigen::Map<const Eigen::Vector4d>(x)) < 0) {
      q = -q;
    }
    return true;
  }

  bool PlusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<PlusMatrix> J(jacobian);
    J.setZero();
    J.topLeftCorner<4, 3>() = 0.5 * QuaternionTangent(x);
    J.bottomRightCorner<3, 3>() = SE3d::FromParameters(x).R();
    return true;
  }

  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<Vec6> xi(y_minus_x);
    xi = (SE3d::FromParameters(x).Inverse() * SE3d::FromParameters(y)).Log();
    return true;
  }

  bool MinusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<MinusMatrix> J(jacobian);
    J = MinusMatrixAt(x);
    return true;
  }

  /// d Minus(y, x) / d y at y = x. A tangent Jacobian J (k x 6) is handed to Ceres as
  /// J * MinusMatrixAt(x): Ceres multiplies by PlusJacobian and gets J back, since
  /// MinusJacobian * PlusJacobian = I. It is also the true derivative in the seven parameters,
  /// because FromParameters divides by the quaternion's norm.
  static MinusMatrix MinusMatrixAt(const double* x) {
    MinusMatrix J = MinusMatrix::Zero();
    const double norm2 = Eigen::Map<const Eigen::Vector4d>(x).squaredNorm();
    J.topLeftCorner<3, 4>() = (2 / norm2) * QuaternionTangent(x).transpose();
    J.bottomRightCorner<3, 3>() = SE3d::FromParameters(x).R().transpose();
    return J;
  }

 private:
  /// q * [omega; 0] as a matrix on omega, rows in the order x y z w.
  static Eigen::Matrix<double, 4, 3> QuaternionTangent(const double* q) {
    Eigen::Matrix<double, 4, 3> m;
    m << q[3], -q[2], q[1], q[2], q[3], -q[0], -q[1], q[0], q[3], -q[0], -q[1], -q[2];
    return m;
  }
};

/// SE(3) with steps only in the free directions, as ceres::SubsetManifold is for vectors, with
/// Plus(x, d) = x Exp(S d), Minus(y, x) = S^T Log(x^-1 y), where the columns of S (6 x k) are the
/// unit vectors of the mask. kPlanarDof is closed under composition: however many steps, the body
/// stays in the x-y plane that it started in; other masks restrict each step only. As in Ceres' own
/// manifold, Minus is the inverse only of Plus.
class SE3SubsetManifold final : public ceres::Manifold {
 public:
  /// At least one direction must be free.
  explicit SE3SubsetManifold(const DofMask& free) {
    for (int i = 0; i < 6; ++i) {
      if (free[static_cast<std::size_t>(i)]) {
        free_.push_back(i);
      }
    }
  }

  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return static_cast<int>(free_.size()); }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    Vec6 xi = Vec6::Zero();
    for (int k = 0; k < TangentSize(); ++k) {
      xi[free_[static_cast<std::size_t>(k)]] = delta[k];
    }
    return whole_.Plus(x, xi.data(), x_plus_delta);
  }

  bool PlusJacobian(const double* x, double* jacobian) const override {
    SE3Manifold::PlusMatrix whole;
    whole_.PlusJacobian(x, whole.data());
    RowMajor J(jacobian, 7, TangentSize());
    for (int k = 0; k < TangentSize(); ++k) {
      J.col(k) = whole.col(free_[static_cast<std::size_t>(k)]);
    }
    return true;
  }

  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Vec6 xi;
    whole_.Minus(y, x, xi.data());
    for (int k = 0; k < TangentSize(); ++k) {
      y_minus_x[k] = xi[free_[static_cast<std::size_t>(k)]];
    }
    return true;
  }

  bool MinusJacobian(const double* x, double* jacobian) const override {
    const SE3Manifold::MinusMatrix whole = SE3Manifold::MinusMatrixAt(x);
    RowMajor J(jacobian, TangentSize(), 7);
    for (int k = 0; k < TangentSize(); ++k) {
      J.row(k) = whole.row(free_[static_cast<std::size_t>(k)]);
    }
    return true;
  }

 private:
  using RowMajor =
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

  SE3Manifold whole_;
  std::vector<int> free_;
};

/// One correspondence as a Ceres cost function over the SE(3) block. The simplest way to use a
/// metric in a ceres::Problem; for a hundred thousand pairs see SquareRootCost.
template <class Metric>
class CeresCost final : public ceres::SizedCostFunction<Metric::kDim, 7> {
 public:
  explicit CeresCost(Metric metric) : metric_(std::move(metric)) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const SE3d T = SE3d::FromParameters(parameters[0]);
    Eigen::Map<Vec<double, Metric::kDim>> r(residuals);
    r = metric_.Residual(T);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Metric::kDim, 7, Eigen::RowMajor>> J(jacobians[0]);
      J = metric_.Jacobian(T) * SE3Manifold::MinusMatrixAt(parameters[0]);
    }
    return true;
  }

 private:
  Metric metric_;
};

/// A whole objective as one Ceres cost function with seven residuals.
///
/// With c = 2 cost, g and H the sums over all correspondences (NormalEquations), the block
///   r' = [ y ; sqrt(max(0, c - |y|^2)) ],   J' = [ A ; 0 ]   with  A^T A = H,  A^T y = g
/// has |r'|^2 = c, J'^T r' = g and J'^T J' = H: Ceres' trust region sees exactly the problem of one
/// block per correspondence, at a tenth of the time. A = Lambda^1/2 V^T D comes from the
/// eigen-decomposition of H scaled to a unit diagonal (H = D V Lambda V^T D), so that a problem of
/// fewer than six independent rows (a single plane, three matches) is as good as any other;
/// directions with lambda < 1e-12 lambda_max are dropped.
///
/// The objective is called once per pose: Ceres asks for the value of a candidate first and for the
/// Jacobian at the same pose later, and the second answer is remembered. An objective may match
/// anew at every call, since value and derivatives always come from the same call.
class SquareRootCost final : public ceres::SizedCostFunction<7, 7> {
 public:
  using Function = std::function<NormalEquations(const SE3d& T_target_source)>;

  explicit SquareRootCost(Function objective) : objective_(std::move(objective)) {}

  /// Fails (false) where the objective's sums are not finite or come from a loss with rho'' > 0.
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    if (!evaluated_ || !std::equal(x_.begin(), x_.end(), parameters[0])) {
      std::copy_n(parameters[0], x_.size(), x_.begin());
      Factor(objective_(SE3d::FromParameters(parameters[0])));
      evaluated_ = true;
    }
    if (!valid_) {
      return false;
    }
    Eigen::Map<Vec<double, 7>> r(residuals);
    r = residual_;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 7, 7, Eigen::RowMajor>> J(jacobians[0]);
      J.topRows<6>() = factor_ * SE3Manifold::MinusMatrixAt(parameters[0]);
      J.row(6).setZero();
    }
    return true;
  }

 private:
  void Factor(const NormalEquations& sums) const {
    const Mat6 H = sums.Hessian();
    valid_ =
        H.allFinite() && sums.gradient.allFinite() && std::isfinite(sums.cost) && !sums.upward_loss;
    if (!valid_) {
      return;
    }
    const Vec6 scale = H.diagonal().unaryExpr([](double h) { return h > 0 ? std::sqrt(h) : 1.0; });
    const Vec6 inverse_scale = scale.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Mat6> eigen(inverse_scale.asDiagonal() * H *
                                                    inverse_scale.asDiagonal());
    const double lambda_max = eigen.eigenvalues()[5];
    const Vec6 projected =
        eigen.eigenvectors().transpose() * (inverse_scale.asDiagonal() * sums.gradient);
    factor_.setZero();
    residual_.setZero();
    for (int i = 0; i < 6; ++i) {
      const double lambda = eigen.eigenvalues()[i];
      if (lambda > 0 && lambda >= 1e-12 * lambda_max) {
        const double root = std::sqrt(lambda);
        factor_.row(i) = root * eigen.eigenvectors().col(i).transpose() * scale.asDiagonal();
        residual_[i] = projected[i] / root;
      }
    }
    residual_[6] = std::sqrt(std::max(0.0, 2 * sums.cost - residual_.head<6>().squaredNorm()));
  }

  Function objective_;
  mutable bool evaluated_ = false;
  mutable bool valid_ = false;
  mutable std::array<double, 7> x_{};
  mutable Mat6 factor_;
  mutable Vec<double, 7> residual_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_ADAPTERS_CERES_H_
