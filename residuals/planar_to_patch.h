// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_PLANAR_TO_PATCH_H_
#define ICPSCAPE_RESIDUALS_PLANAR_TO_PATCH_H_

#include "correspondence.h"
#include "point_to_plane.h"

namespace icpscape {

/// Planar point to planar patch as the paper prints it [paper sec. 2.4.2].
///   r(T) = (R p + t - q) / A,  A = |(q_j - q_k) x (q_j - q_l)|          3x1, 1/m
///   J    = R [ -skew(p) | I ] / A                                       3x6
/// The paper's term is |[T p - q; n]| / |n| = sqrt(1 + |r|^2), of which it subtracts one: that is
/// 1/2 rho(|r|^2) of SoftLOneLoss(1), which belongs to this metric unless another loss is asked
/// for. (Written as sqrt(1 + |r|^2) - 1 it would have no Jacobian at a match.) It is not a plane
/// metric: a slide within the plane costs as much as the same distance off it. It depends on the
/// size of the virtual triangle: A is twice its area. LOAM's own distance is PlanarToPlane. Smooth
/// everywhere.
template <class Scalar>
struct PlanarToPatchOf {
  static constexpr char kName[] = "planar_to_patch";
  static constexpr char kFormula[] = "(T p - q) / |n|";
  static constexpr char kSource[] = "paper sec. 2.4.2, as printed";
  static constexpr int kDim = 3;
  static constexpr unsigned kNeeds = kTargetPatch;
  static constexpr Epsilon kEpsilon = Epsilon::kSoftNorm;

  Vec<Scalar, 3> p_source;
  Vec<Scalar, 3> q_patch;
  Scalar area_patch;

  static PlanarToPatchOf From(const CorrespondenceOf<Scalar>& c) {
    return {c.p_source, c.q_patch, c.area_patch};
  }

  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    const Vec<S, 3> e = T_target_source * p_source.template cast<S>() - q_patch.template cast<S>();
    return e / S(area_patch);
  }

  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    const Mat<Scalar, 3, 3> R = T_target_source.R() / area_patch;
    Mat<Scalar, kDim, 6> J;
    J << -R * Skew<Scalar>(p_source), R;
    return J;
  }
};
using PlanarToPatch = PlanarToPatchOf<double>;

/// Planar point to planar patch as in LOAM: the signed distance from the plane through the patch
/// [Zhang & Singh 2014, eq. 3]. Formula and derivative are PointToPlane's; the plane is fitted to
/// the neighbours of T p instead of being a precomputed normal of the closest point.
template <class Scalar>
struct PlanarToPlaneOf {
  static constexpr char kName[] = "planar_to_plane";
  static constexpr char kFormula[] = "(T p - q) . n";
  static constexpr char kSource[] = "Zhang & Singh 2014 (LOAM), eq. 3";
  static constexpr int kDim = 1;
  static constexpr unsigned kNeeds = kTargetPatch;
  static constexpr Epsilon kEpsilon = Epsilon::kSquared;

  PointToPlaneOf<Scalar> plane;

  static PlanarToPlaneOf From(const CorrespondenceOf<Scalar>& c) {
    return {PointToPlaneOf<Scalar>{c.p_source, c.q_patch, c.n_patch}};
  }
  template <class S>
  Vec<S, kDim> Residual(const SE3<S>& T_target_source) const {
    return plane.Residual(T_target_source);
  }
  Mat<Scalar, kDim, 6> Jacobian(const SE3<Scalar>& T_target_source) const {
    return plane.Jacobian(T_target_source);
  }
};
using PlanarToPlane = PlanarToPlaneOf<double>;

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_PLANAR_TO_PATCH_H_
