// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_LIE_H_
#define ICPSCAPE_RESIDUALS_LIE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace icpscape {

/// Fixed-size matrices; a single row is stored row-major, as Eigen demands.
template <class S, int kRows, int kCols>
using Mat =
    Eigen::Matrix<S, kRows, kCols, (kRows == 1 && kCols != 1) ? Eigen::RowMajor : Eigen::ColMajor>;
template <class S, int kRows>
using Vec = Eigen::Matrix<S, kRows, 1>;
using Vec3 = Vec<double, 3>;
using Vec6 = Vec<double, 6>;
using Mat3 = Mat<double, 3, 3>;
using Mat6 = Mat<double, 6, 6>;

/// The 3x3 matrix [v]x with [v]x w = v x w.
template <class S>
Mat<S, 3, 3> Skew(const Vec<S, 3>& v) {
  Mat<S, 3, 3> m;
  m << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
  return m;
}

namespace internal {

// Below this squared angle the closed forms lose digits by cancellation and the series, cut where
// the next term is below 1e-17 of the sum, take over. Every branch is on theta^2, never on theta:
// sqrt has no derivative at 0, and a Jet must stay finite there.
constexpr double kSeriesAngleSquared = 0.25;

/// sin(theta) / theta.
template <class S>
S SinOverAngle(const S& theta2) {
  using std::sin, std::sqrt;
  if (theta2 < S(kSeriesAngleSquared)) {
    return S(1) +
           theta2 * (S(-1. / 6) +
                     theta2 * (S(1. / 120) +
                               theta2 * (S(-1. / 5040) +
                                         theta2 * (S(1. / 362880) +
                                                   theta2 * (S(-1. / 39916800) +
                                                             theta2 * S(1. / 6227020800))))));
  }
  const S theta = sqrt(theta2);
  return sin(theta) / theta;
}

/// (1 - cos(theta)) / theta^2, from the half angle: no cancellation.
template <class S>
S OneMinusCosOverAngle2(const S& theta2) {
  const S half = SinOverAngle(S(theta2 / S(4)));
  return half * half / S(2);
}

/// (theta - sin(theta)) / theta^3.
template <class S>
S AngleMinusSinOverAngle3(const S& theta2) {
  if (theta2 < S(kSeriesAngleSquared)) {
    return S(1. / 6) +
           theta2 * (S(-1. / 120) +
                     theta2 * (S(1. / 5040) +
                               theta2 * (S(-1. / 362880) +
                                         theta2 * (S(1. / 39916800) +
                                                   theta2 * (S(-1. / 6227020800) +
                                                             theta2 * S(1. / 1307674368000))))));
  }
  return (S(1) - SinOverAngle(theta2)) / theta2;
}

/// (1 - (theta/2) cot(theta/2)) / theta^2: the last coefficient of the inverse left Jacobian.
/// Finite up to theta < 2 pi.
template <class S>
S InverseJacobianCoefficient(const S& theta2) {
  using std::cos, std::sin, std::sqrt;
  if (theta2 < S(kSeriesAngleSquared)) {
    return S(1. / 12) +
           theta2 * (S(1. / 720) +
                     theta2 * (S(1. / 30240) +
                               theta2 * (S(1. / 1209600) +
                                         theta2 * (S(1. / 47900160) +
                                                   theta2 * (S(691. / 1307674368000) +
                                                             theta2 * S(1. / 74724249600))))));
  }
  const S half = sqrt(theta2) / S(2);
  return (S(1) - half * cos(half) / sin(half)) / theta2;
}

}  // namespace internal

/// Rigid motion p -> R p + t. Named T_target_source throughout: p_target = T_target_source *
/// p_source.
///
/// Tangent vectors are xi = [omega; v]: rotation (rad) first, then translation (m). Poses are
/// updated from the right, T <- T Exp(xi), with the true exponential of SE(3) [Barfoot 2017, ch.
/// 7]. Scalar may be a ceres::Jet.
template <class Scalar>
class SE3 {
 public:
  using Vector3 = Vec<Scalar, 3>;
  using Vector6 = Vec<Scalar, 6>;
  using Matrix3 = Mat<Scalar, 3, 3>;

  /// The identity.
  SE3() : R_(Matrix3::Identity()), t_(Vector3::Zero()) {}
  /// R must be a rotation matrix, or nearly one; it is used as it is (see Normalized).
  SE3(const Matrix3& R, const Vector3& t) : R_(R), t_(t) {}

  const Matrix3& R() const { return R_; }
  const Vector3& t() const { return t_; }

  Vector3 operator*(const Vector3& p) const { return R_ * p + t_; }
  SE3 operator*(const SE3& other) const { return SE3(R_ * other.R_, R_ * other.t_ + t_); }
  SE3 Inverse() const { return SE3(R_.transpose(), -(R_.transpose() * t_)); }

  /// R as a unit quaternion with w >= 0.
  Eigen::Quaternion<Scalar> Quaternion() const {
    Eigen::Quaternion<Scalar> q(R_);
    q.normalize();
    if (q.w() < Scalar(0)) {
      q.coeffs() = -q.coeffs();
    }
    return q;
  }

  /// The same motion with R projected back onto SO(3): for matrices read from text.
  SE3 Normalized() const { return SE3(Quaternion().toRotationMatrix(), t_); }

  /// exp([omega; v]): R = Exp(omega), t = V(omega) v.
  static SE3 Exp(const Vector6& xi) {
    const Vector3 omega = xi.template head<3>();
    const Scalar theta2 = omega.squaredNorm();
    const Scalar a = internal::SinOverAngle(theta2);
    const Scalar b = internal::OneMinusCosOverAngle2(theta2);
    const Scalar c = internal::AngleMinusSinOverAngle3(theta2);
    const Matrix3 K = Skew<Scalar>(omega);
    const Matrix3 K2 = K * K;
    const Matrix3 identity = Matrix3::Identity();
    const Matrix3 R = identity + a * K + b * K2;
    const Matrix3 V = identity + b * K + c * K2;
    return SE3(R, V * xi.template tail<3>());
  }

  /// The inverse of Exp, |omega| <= pi. At a rotation by exactly pi either axis sign is right.
  Vector6 Log() const {
    const Vector3 omega = LogRotation();
    const Matrix3 K = Skew<Scalar>(omega);
    const Scalar c = internal::InverseJacobianCoefficient(Scalar(omega.squaredNorm()));
    Vector6 xi;
    xi.template head<3>() = omega;
    xi.template tail<3>() = t_ - K * t_ / Scalar(2) + c * (K * (K * t_));
    return xi;
  }

  /// Rotation vector of R (rad).
  Vector3 LogRotation() const {
    using std::atan2, std::sqrt;
    const Eigen::Quaternion<Scalar> q = Quaternion();
    const Scalar s2 = q.vec().squaredNorm();
    // omega = 2 atan2(s, w) / s * vec; the ratio's series where s is too small to divide by.
    if (s2 < Scalar(1e-10)) {
      const Scalar w2 = q.w() * q.w();
      return q.vec() * (Scalar(2) / q.w() * (Scalar(1) - s2 / (Scalar(3) * w2)));
    }
    const Scalar s = sqrt(s2);
    return q.vec() * (Scalar(2) * atan2(s, q.w()) / s);
  }

  /// The 6x6 matrix with T Exp(xi) T^-1 = Exp(Adjoint xi), blocks [R 0; [t]x R  R].
  Mat<Scalar, 6, 6> Adjoint() const {
    Mat<Scalar, 6, 6> ad = Mat<Scalar, 6, 6>::Zero();
    ad.template topLeftCorner<3, 3>() = R_;
    ad.template bottomRightCorner<3, 3>() = R_;
    ad.template bottomLeftCorner<3, 3>() = Skew<Scalar>(t_) * R_;
    return ad;
  }

  /// Homogeneous 4x4 matrix.
  Mat<Scalar, 4, 4> Matrix() const {
    Mat<Scalar, 4, 4> m = Mat<Scalar, 4, 4>::Identity();
    m.template topLeftCorner<3, 3>() = R_;
    m.template topRightCorner<3, 1>() = t_;
    return m;
  }

  template <class Other>
  SE3<Other> cast() const {
    return SE3<Other>(R_.template cast<Other>(), t_.template cast<Other>());
  }

  /// Seven parameters [qx qy qz qw tx ty tz] (Eigen's and Sophus' order). The quaternion need not
  /// be of unit length: it is divided by its norm, so that numeric derivatives may step off the
  /// sphere.
  static SE3 FromParameters(const Scalar* x) {
    const Eigen::Quaternion<Scalar> q(x[3], x[0], x[1], x[2]);
    return SE3(q.normalized().toRotationMatrix(), Vector3(x[4], x[5], x[6]));
  }
  void ToParameters(Scalar* x) const {
    const Eigen::Quaternion<Scalar> q = Quaternion();
    x[0] = q.x(), x[1] = q.y(), x[2] = q.z(), x[3] = q.w();
    x[4] = t_.x(), x[5] = t_.y(), x[6] = t_.z();
  }

 private:
  Matrix3 R_;
  Vector3 t_;
};

using SE3d = SE3<double>;

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_LIE_H_
