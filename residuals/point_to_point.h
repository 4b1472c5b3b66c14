// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_POINT_TO_POINT_H_
#define ICPSCAPE_RESIDUALS_POINT_TO_POINT_H_

#include "correspondence.h"

namespace icpscape {

/// Point-to-point distance [Besl & McKay 1992; paper sec. 2.1].
///   r(T) = R p + t - q                     3x1, metres
///   J    = R [ -skew(p) | I ]              3x6, T <- T Exp([omega; v])
/// Smooth everywhere. Null space of one pair: rotations about the point.
template <class Scalar>
struct PointToPointOf {
  static constexpr char kName[] = "point_to_point";
  static constexpr char kFormula[] = "T p - q";
  static constexpr char kSource[] = "Besl & McKay 1992; paper sec. 2.1";
  static constexpr int kDim = 3;
  static constexpr unsigned kNeeds = kPointsOnly;
  static constexpr Epsilon kEpsilon = Epsilon::kSquared;

  Vec<Scalar, 3> p_source;
  Vec<Scalar, 3> q_target;

  static PointToPointOf From(const CorrespondenceOf<Scalar>& c) { return {c.p_source, c.q_target}; }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    return T_target_source * p_source.template cast<S>() - q_target.template cast<S>();
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    const Mat<Scalar, 3, 3>& R = T_target_source.R();
    Mat<Scalar, kDim, 6> J;
    for (int row = 0; row < kDim; ++row) {
      // a^T [-skew(p)] = (p x a)^T.
      J.row(row) << p_source.cross(R.row(row).transpose()).transpose(), R.row(row);
    }
    return J;
  }
};
using PointToPoint = PointToPointOf<double>;

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_POINT_TO_POINT_H_
