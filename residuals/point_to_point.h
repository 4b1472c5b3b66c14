// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_POINT_TO_POINT_H_
#define ICPSCAPE_RESIDUALS_POINT_TO_POINT_H_

#include "residuals/correspondence.h"

namespace icpscape {

/// Point-to-point distance [Besl & McKay 1992; paper sec. 2.1].
///   r(T) = R p_s + t - q_t                 3x1, metres
///   J    = R [ -skew(p_s) | I ]            3x6, T <- T Exp([omega; v])
/// Smooth everywhere. Null space of one pair: rotations about the point.
struct PointToPoint {
  static constexpr char kName[] = "point_to_point";
  static constexpr char kFormula[] = "T p - q";
  static constexpr char kSource[] = "Besl & McKay 1992; paper sec. 2.1";
  static constexpr int kDim = 3;
  static constexpr unsigned kNeeds = kPointsOnly;
  static constexpr Epsilon kEpsilon = Epsilon::kSquared;

  Vec3 p_source;
  Vec3 q_target;

  static PointToPoint From(const Correspondence& c) { return {c.p_source, c.q_target}; }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    return T_target_source * p_source.cast<S>() - q_target.cast<S>();
  }

  Mat<double, kDim, 6> Jacobian(const SE3d& T_target_source) const {
    const Mat3& R = T_target_source.R();
    Mat<double, kDim, 6> J;
    for (int row = 0; row < kDim; ++row) {
      // a^T [-skew(p)] = (p x a)^T.
      J.row(row) << p_source.cross(R.row(row).transpose()).transpose(), R.row(row);
    }
    return J;
  }
};

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_POINT_TO_POINT_H_
