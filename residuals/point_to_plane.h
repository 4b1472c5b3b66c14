// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_POINT_TO_PLANE_H_
#define ICPSCAPE_RESIDUALS_POINT_TO_PLANE_H_

#include "correspondence.h"

namespace icpscape {

/// Point-to-plane distance [Chen & Medioni 1992; paper sec. 2.2].
///   r(T) = n_q . (R p + t - q)                 1x1, metres
///   J    = n_q^T R [ -skew(p) | I ]            1x6, T <- T Exp([omega; v])
/// n_q is n_target. Smooth everywhere; its sign is irrelevant; blind to motion within the plane.
template <class Scalar>
struct PointToPlaneOf {
  static constexpr char kName[] = "point_to_plane";
  static constexpr char kFormula[] = "(T p - q) . n_q";
  static constexpr char kSource[] = "Chen & Medioni 1992; paper sec. 2.2";
  static constexpr int kDim = 1;
  static constexpr unsigned kNeeds = kTargetNormal;
  static constexpr Epsilon kEpsilon = Epsilon::kSquared;

  Vec<Scalar, 3> p_source;
  Vec<Scalar, 3> q_target;
  Vec<Scalar, 3> n_target;

  static PointToPlaneOf From(const CorrespondenceOf<Scalar>& c) {
    return {c.p_source, c.q_target, c.n_target};
  }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    const Vec<S, 3> e = T_target_source * p_source.template cast<S>() - q_target.template cast<S>();
    return Vec<S, kDim>(n_target.template cast<S>().dot(e));
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    // a^T [-skew(p)] = (p x a)^T, with a the normal seen from the source frame.
    const Vec<Scalar, 3> a = T_target_source.R().transpose() * n_target;
    Mat<Scalar, kDim, 6> J;
    J << p_source.cross(a).transpose(), a.transpose();
    return J;
  }
};
using PointToPlane = PointToPlaneOf<double>;

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_POINT_TO_PLANE_H_
