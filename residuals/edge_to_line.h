// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_EDGE_TO_LINE_H_
#define ICPSCAPE_RESIDUALS_EDGE_TO_LINE_H_

#include "correspondence.h"

namespace icpscape {

/// Edge point to edge line [Zhang & Singh 2014, eq. 2; paper sec. 2.4.1].
///   r(T) = d x (R p + t - a)                     3x1, metres, |d| = 1
///   J    = skew(d) R [ -skew(p) | I ]            3x6, T <- T Exp([omega; v])
/// |r| is the distance from the line. As a vector it is smooth everywhere, also on the line; the
/// paper sums |r|, the solver 1/2 |r|^2. Blind to motion along the line and to turns about the
/// point; the sign of d is irrelevant.
template <class Scalar>
struct EdgeToLineOf {
  static constexpr char kName[] = "edge_to_line";
  static constexpr char kFormula[] = "d x (T p - a)";
  static constexpr char kSource[] = "Zhang & Singh 2014 (LOAM); paper sec. 2.4.1";
  static constexpr int kDim = 3;
  static constexpr unsigned kNeeds = kTargetLine;
  static constexpr Epsilon kEpsilon = Epsilon::kNorm;

  Vec<Scalar, 3> p_source;
  Vec<Scalar, 3> a_line;
  Vec<Scalar, 3> d_line;

  static EdgeToLineOf From(const CorrespondenceOf<Scalar>& c) {
    return {c.p_source, c.a_line, c.d_line};
  }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    const Vec<S, 3> e = T_target_source * p_source.template cast<S>() - a_line.template cast<S>();
    return d_line.template cast<S>().cross(e);
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    const Mat<Scalar, 3, 3> dR = Skew<Scalar>(d_line) * T_target_source.R();
    Mat<Scalar, kDim, 6> J;
    J << -dR * Skew<Scalar>(p_source), dR;
    return J;
  }
};
using EdgeToLine = EdgeToLineOf<double>;

namespace internal {

// The root of a Jet has no derivative at 0, and 1/0 has no value: both are 0 there.
template <class S>
S RootOrZero(const S& x) {
  using std::sqrt;
  return x > S(0) ? S(sqrt(x)) : S(0);
}
template <class S>
S InverseOrZero(const S& x) {
  return x > S(0) ? S(S(1) / x) : S(0);
}

}  // namespace internal

/// The same distance as a number [as in F-LOAM]: |d x (T p - a)|.
///   r(T) = |w|,  w = d x (R p + t - a)           1x1, metres
///   J    = (w / |w|)^T skew(d) R [ -skew(p) | I ];  0 on the line
/// Not smooth on the line (r = 0), where a real minimum lies: prefer EdgeToLine.
template <class Scalar>
struct EdgeToLineDistanceOf {
  static constexpr char kName[] = "edge_to_line_distance";
  static constexpr char kFormula[] = "|d x (T p - a)|";
  static constexpr char kSource[] = "Zhang & Singh 2014, eq. 2, as a scalar";
  static constexpr int kDim = 1;
  static constexpr unsigned kNeeds = kTargetLine;
  static constexpr Epsilon kEpsilon = Epsilon::kNorm;

  EdgeToLineOf<Scalar> line;

  static EdgeToLineDistanceOf From(const CorrespondenceOf<Scalar>& c) {
    return {EdgeToLineOf<Scalar>::From(c)};
  }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    using internal::RootOrZero;
    return Vec<S, kDim>(RootOrZero(S(line.Residual(T_target_source).squaredNorm())));
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    const Vec<Scalar, 3> w = line.Residual(T_target_source);
    using internal::InverseOrZero;
    using internal::RootOrZero;
    const Scalar inverse = InverseOrZero(RootOrZero(Scalar(w.squaredNorm())));
    return (w * inverse).transpose() * line.Jacobian(T_target_source);
  }
};
using EdgeToLineDistance = EdgeToLineDistanceOf<double>;

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_EDGE_TO_LINE_H_
