// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_EDGE_TO_LINE_H_
#define ICPSCAPE_RESIDUALS_EDGE_TO_LINE_H_

#include "residuals/correspondence.h"

namespace icpscape {

/// Edge point to edge line [Zhang & Singh 2014, eq. 2; paper sec. 2.4.1].
///   r(T) = d x (R p_s + t - a)                   3x1, metres, |d| = 1
///   J    = skew(d) R [ -skew(p_s) | I ]          3x6, T <- T Exp([omega; v])
/// |r| is the distance from the line. As a vector it is smooth everywhere, also on the line; the
/// paper sums |r|, the solver 1/2 |r|^2. Blind to motion along the line and to turns about the
/// point; the sign of d is irrelevant.
struct EdgeToLine {
  static constexpr char kName[] = "edge_to_line";
  static constexpr char kFormula[] = "d x (T p - a)";
  static constexpr char kSource[] = "Zhang & Singh 2014 (LOAM); paper sec. 2.4.1";
  static constexpr int kDim = 3;
  static constexpr unsigned kNeeds = kTargetLine;
  static constexpr Epsilon kEpsilon = Epsilon::kNorm;

  Vec3 p_source;
  Vec3 a_line;
  Vec3 d_line;

  static EdgeToLine From(const Correspondence& c) { return {c.p_source, c.a_line, c.d_line}; }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    const Vec<S, 3> e = T_target_source * p_source.cast<S>() - a_line.cast<S>();
    return d_line.cast<S>().cross(e);
  }

  Mat<double, kDim, 6> Jacobian(const SE3d& T_target_source) const {
    const Mat3 dR = Skew<double>(d_line) * T_target_source.R();
    Mat<double, kDim, 6> J;
    J << -dR * Skew<double>(p_source), dR;
    return J;
  }
};

/// The same distance as a number [as in F-LOAM]: |d x (T p - a)|.
///   r(T) = |w|,  w = d x (R p_s + t - a)         1x1, metres
///   J    = (w / |w|)^T skew(d) R [ -skew(p_s) | I ];  0 on the line
/// Not smooth on the line (r = 0), where a real minimum lies: prefer EdgeToLine.
struct EdgeToLineDistance {
  static constexpr char kName[] = "edge_to_line_distance";
  static constexpr char kFormula[] = "|d x (T p - a)|";
  static constexpr char kSource[] = "Zhang & Singh 2014, eq. 2, as a scalar";
  static constexpr int kDim = 1;
  static constexpr unsigned kNeeds = kTargetLine;
  static constexpr Epsilon kEpsilon = Epsilon::kNorm;

  EdgeToLine line;

  static EdgeToLineDistance From(const Correspondence& c) { return {EdgeToLine::From(c)}; }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    using std::sqrt;
    const S squared = line.Residual(T_target_source).squaredNorm();
    return Vec<S, kDim>(squared > S(0) ? S(sqrt(squared)) : S(0));
  }

  Mat<double, kDim, 6> Jacobian(const SE3d& T_target_source) const {
    const Vec3 w = line.Residual(T_target_source);
    const double norm = w.norm();
    if (norm == 0) {
      return Mat<double, kDim, 6>::Zero();
    }
    return (w / norm).transpose() * line.Jacobian(T_target_source);
  }
};

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_EDGE_TO_LINE_H_
