// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COVARIANCE_PAIR_DERIVATIVES_H_
#define ICPSCAPE_SRC_COVARIANCE_PAIR_DERIVATIVES_H_

#include "icpscape/objective/registered_metric.h"
#include "icpscape/residuals/correspondence.h"

namespace ceres {
class LossFunction;
}

namespace icpscape {

/// Where the sensors were, each in the frame of its cloud.
struct Sensors {
  Vec3 source = Vec3::Zero();
  Vec3 target = Vec3::Zero();
};

/// One pair's gradient g = rho' J^T r, and how it depends on the pose and on what was measured.
///
/// Measured are the two ranges: p_source moves along its ray by d_p, and q_target along its own by
/// d_q (a fitted line or patch moves with its closest point). Normals and directions
/// of fits are constants: how they follow the ranges is left out.
struct PairDerivatives {
  Vec6 gradient;         ///< d cost / d xi, T <- T Exp(xi).
  Mat6 gauss_newton;     ///< rho' J^T J
  Mat6 gradient_by_xi;   ///< d g(T Exp(xi)) / d xi; its symmetric part is the exact Hessian.
  Vec6 by_source_range;  ///< d g / d d_p
  Vec6 by_target_range;  ///< d g / d d_q
  int rows;              ///< Of the residual.
};

/// By automatic differentiation of the metric's own Residual and Jacobian. Where those have no
/// derivative (edge_to_line_distance on the line) they are taken for constant.
using PairDerivativesFunction = PairDerivatives (*)(const Correspondence& pair,
                                                    const SE3d& T_target_source,
                                                    const ceres::LossFunction* loss,
                                                    const Sensors& sensors);

PairDerivativesFunction PairDerivativesOf(const RegisteredMetric& metric);

/// The first derivatives alone, without automatic differentiation.
struct PairGradient {
  Vec6 gradient;  ///< As in PairDerivatives, and so are the others.
  Mat6 gauss_newton;
  int rows;
};
using PairGradientFunction = PairGradient (*)(const Correspondence& pair,
                                              const SE3d& T_target_source,
                                              const ceres::LossFunction* loss);
PairGradientFunction PairGradientOf(const RegisteredMetric& metric);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COVARIANCE_PAIR_DERIVATIVES_H_
