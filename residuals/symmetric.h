// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_SYMMETRIC_H_
#define ICPSCAPE_RESIDUALS_SYMMETRIC_H_

#include "correspondence.h"

// Four metrics go by the name "symmetric"; they differ in what turns with T. With
// e = R p + t - q, n_p = n_source and n_q = n_target, each turned towards its sensor:
//
//   symmetric          e . (n_p + n_q)                 as the paper prints it: normals do not turn
//   symmetric_rotated  e . (R n_p + n_q)               Rusinkiewicz's split form, normals turned
//   symmetric_split    e . R^1/2 (n_p + n_q)           Rusinkiewicz's split form, normals fixed
//   two_plane          [ e . n_q ; e . R n_p ]         both point-to-plane distances
//
// Rusinkiewicz 2019 splits the rotation, R = Q Q, and writes (Q p - Q^-1 q + t') . n with t = Q t'.
// Multiplied by Q that is e . Q n: with n = Q n_p + Q^-1 n_q the rotated form, with
// n = n_p + n_q the split form. |n_p + n_q| is near 2, so the first three read about twice the
// point-to-plane distance.

namespace icpscape {

/// Symmetric objective as printed [paper sec. 2.3]: T acts on the point only.
///   r(T) = (R p + t - q) . (n_p + n_q)            1x1, metres (about twice the distance)
///   J    = m^T R [ -skew(p) | I ],  m = n_p + n_q
/// Smooth everywhere. n_p is added without R, so the value depends on the choice of frames: it
/// changes when only the target frame turns.
template <class Scalar>
struct SymmetricOf {
  static constexpr char kName[] = "symmetric";
  static constexpr char kFormula[] = "(T p - q) . (n_p + n_q)";
  static constexpr char kSource[] = "paper sec. 2.3, after Rusinkiewicz 2019";
  static constexpr int kDim = 1;
  static constexpr unsigned kNeeds = kSourceNormal | kTargetNormal;
  static constexpr Epsilon kEpsilon = Epsilon::kSquared;

  Vec<Scalar, 3> p_source;
  Vec<Scalar, 3> q_target;
  Vec<Scalar, 3> n_sum;  ///< n_source + n_target, each in its own frame.

  static SymmetricOf From(const CorrespondenceOf<Scalar>& c) {
    return {c.p_source, c.q_target, c.n_source + c.n_target};
  }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    const Vec<S, 3> e = T_target_source * p_source.template cast<S>() - q_target.template cast<S>();
    return Vec<S, kDim>(n_sum.template cast<S>().dot(e));
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    const Vec<Scalar, 3> a = T_target_source.R().transpose() * n_sum;
    Mat<Scalar, kDim, 6> J;
    J << p_source.cross(a).transpose(), a.transpose();
    return J;
  }
};
using Symmetric = SymmetricOf<double>;

/// Symmetric objective whose source normal turns with the point [Rusinkiewicz 2019, eq. 10, split
/// with rotated normals].
///   r(T) = e . (R n_p + n_q),  e = R p + t - q                  1x1, metres
///   J    = m^T R [ -skew(p) | I ] + [ -e^T R skew(n_p) | 0 ],  m = R n_p + n_q
/// Smooth everywhere; invariant to the choice of either frame.
template <class Scalar>
struct SymmetricRotatedOf {
  static constexpr char kName[] = "symmetric_rotated";
  static constexpr char kFormula[] = "(T p - q) . (R n_p + n_q)";
  static constexpr char kSource[] = "Rusinkiewicz 2019, rotated normals";
  static constexpr int kDim = 1;
  static constexpr unsigned kNeeds = kSourceNormal | kTargetNormal;
  static constexpr Epsilon kEpsilon = Epsilon::kSquared;

  Vec<Scalar, 3> p_source;
  Vec<Scalar, 3> q_target;
  Vec<Scalar, 3> n_source;
  Vec<Scalar, 3> n_target;

  static SymmetricRotatedOf From(const CorrespondenceOf<Scalar>& c) {
    return {c.p_source, c.q_target, c.n_source, c.n_target};
  }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    const Vec<S, 3> e = T_target_source * p_source.template cast<S>() - q_target.template cast<S>();
    const Vec<S, 3> m =
        T_target_source.R() * n_source.template cast<S>() + n_target.template cast<S>();
    return Vec<S, kDim>(m.dot(e));
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    const Mat<Scalar, 3, 3>& R = T_target_source.R();
    const Vec<Scalar, 3> a = n_source + R.transpose() * n_target;                          // R^T m
    const Vec<Scalar, 3> b = p_source + R.transpose() * (T_target_source.t() - q_target);  // R^T e
    Mat<Scalar, kDim, 6> J;
    J << (p_source.cross(a) + n_source.cross(b)).transpose(), a.transpose();
    return J;
  }
};
using SymmetricRotated = SymmetricRotatedOf<double>;

/// Symmetric objective with the rotation split between the clouds and the normals fixed
/// [Rusinkiewicz 2019, eq. 9]: each cloud turns half way, so the sum of normals turns by R^1/2.
///   r(T) = e . H m,  H = R^1/2, m = n_p + n_q, e = R p + t - q           1x1, metres
///   J    = m^T H^T R [ -skew(p) | I ] + [ -e^T H skew(m) M | 0 ],
///   M    = (I + skew(h_v) / h_w) / 2,  [h_w; h_v] the quaternion of H
/// M is the derivative of Log(H) with respect to omega: the quotient of right Jacobians
/// J_r(phi/2) J_r(phi)^-1 / 2 collapses to tan(theta/4). Not smooth where R turns by pi (H jumps).
/// Depends on the choice of frames, as Symmetric does.
template <class Scalar>
struct SymmetricSplitOf {
  static constexpr char kName[] = "symmetric_split";
  static constexpr char kFormula[] = "(T p - q) . R^1/2 (n_p + n_q)";
  static constexpr char kSource[] = "Rusinkiewicz 2019, fixed normals";
  static constexpr int kDim = 1;
  static constexpr unsigned kNeeds = kSourceNormal | kTargetNormal;
  static constexpr Epsilon kEpsilon = Epsilon::kSquared;

  Vec<Scalar, 3> p_source;
  Vec<Scalar, 3> q_target;
  Vec<Scalar, 3> n_sum;

  static SymmetricSplitOf From(const CorrespondenceOf<Scalar>& c) {
    return {c.p_source, c.q_target, c.n_source + c.n_target};
  }

  /// The rotation by half of R's angle about R's axis: q^1/2 = (1 + q) / |1 + q|.
  template <class S>
  static Eigen::Quaternion<S> SquareRoot(const SE3<S>& T_target_source) {
    Eigen::Quaternion<S> h = T_target_source.Quaternion();
    h.w() += S(1);
    h.normalize();
    return h;
  }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    const Vec<S, 3> e = T_target_source * p_source.template cast<S>() - q_target.template cast<S>();
    const Vec<S, 3> m = SquareRoot(T_target_source).toRotationMatrix() * n_sum.template cast<S>();
    return Vec<S, kDim>(m.dot(e));
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    const Eigen::Quaternion<Scalar> h = SquareRoot(T_target_source);
    const Mat<Scalar, 3, 3> H = h.toRotationMatrix();
    const Vec<Scalar, 3> a = T_target_source.R().transpose() * (H * n_sum);
    const Vec<Scalar, 3> e = T_target_source * p_source - q_target;
    const Vec<Scalar, 3> b = n_sum.cross(H.transpose() * e);      // (-e^T H skew(m))^T
    const Vec<Scalar, 3> axis = h.vec() / h.w();                  // tan(theta/4) about the axis
    const Vec<Scalar, 3> turn = (b + b.cross(axis)) / Scalar(2);  // (b^T M)^T
    Mat<Scalar, kDim, 6> J;
    J << (p_source.cross(a) + turn).transpose(), a.transpose();
    return J;
  }
};
using SymmetricSplit = SymmetricSplitOf<double>;

/// Both point-to-plane distances of a pair, stacked (the form that Rusinkiewicz 2019 compares
/// with).
///   r(T) = [ e . n_q ; e . R n_p ],  e = R p + t - q                    2x1, metres
///   J    = [ n_q^T R [ -skew(p) | I ] ;
///            n_p^T [ -skew(p) | I ] + [ (n_p x b)^T | 0 ],  b = R^T e ]
/// Smooth everywhere; signs of the normals are irrelevant; invariant to the choice of either frame.
template <class Scalar>
struct TwoPlaneOf {
  static constexpr char kName[] = "two_plane";
  static constexpr char kFormula[] = "[(T p - q) . n_q ; (T p - q) . R n_p]";
  static constexpr char kSource[] = "compared with in Rusinkiewicz 2019";
  static constexpr int kDim = 2;
  static constexpr unsigned kNeeds = kSourceNormal | kTargetNormal;
  static constexpr Epsilon kEpsilon = Epsilon::kSquared;

  Vec<Scalar, 3> p_source;
  Vec<Scalar, 3> q_target;
  Vec<Scalar, 3> n_source;
  Vec<Scalar, 3> n_target;

  static TwoPlaneOf From(const CorrespondenceOf<Scalar>& c) {
    return {c.p_source, c.q_target, c.n_source, c.n_target};
  }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    const Vec<S, 3> e = T_target_source * p_source.template cast<S>() - q_target.template cast<S>();
    return {n_target.template cast<S>().dot(e),
            (T_target_source.R() * n_source.template cast<S>()).dot(e)};
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    const Mat<Scalar, 3, 3>& R = T_target_source.R();
    const Vec<Scalar, 3> a = R.transpose() * n_target;
    const Vec<Scalar, 3> b = p_source + R.transpose() * (T_target_source.t() - q_target);  // R^T e
    Mat<Scalar, kDim, 6> J;
    J.row(0) << p_source.cross(a).transpose(), a.transpose();
    J.row(1) << (p_source.cross(n_source) + n_source.cross(b)).transpose(), n_source.transpose();
    return J;
  }
};
using TwoPlane = TwoPlaneOf<double>;

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_SYMMETRIC_H_
