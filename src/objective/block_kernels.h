// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_BLOCK_KERNELS_H_
#define ICPSCAPE_SRC_OBJECTIVE_BLOCK_KERNELS_H_

#include <cstddef>

#include "icpscape/objective/block_values.h"
#include "icpscape/simd/level.h"

namespace icpscape {

/// What an evaluation computes besides the values.
enum class Derivatives {
  kNone,      ///< Nothing: gradients and Hessian stay zero.
  kGradient,  ///< What a landscape draws.
  kHessian,   ///< And the Gauss-Newton Hessian: what a solver needs.
};

/// The sums of one metric over a block; what was not asked for stays zero.
struct BlockSums {
  long count;
  double cost;         ///< 1/2 sum rho(s), s = |r|^2.
  double gradient[6];  ///< sum rho'(s) J^T r
  double hessian[21];  ///< sum rho'(s) J^T J, upper triangle row by row.
  double sum_squared;  ///< sum s
  double epsilon;      ///< sum eps(s)
  double epsilon_gradient[6];
  bool upward_loss;  ///< rho''(s) > 0 somewhere.
};

/// rho and eps for eight squared residual norms at once; null: rho(s) = eps(s) = s.
struct BlockTerms {
  struct Values {
    double rho[8], rho_slope[8], rho_curvature[8];
    double epsilon[8], epsilon_slope[8];
  };
  void (*evaluate)(const void* context, const double squared[8], Values* values);
  const void* context;
};

/// One metric over one block: T_target_source as R (row by row) and t.
using BlockKernel = void (*)(const BlockValues& block, const double rotation[9],
                             const double translation[3], Derivatives derivatives,
                             const BlockTerms* terms, BlockSums* sums);

/// The kernel of a registered metric, by its place in AllMetrics.
BlockKernel BlockKernelOf(std::size_t metric, SimdLevel level);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_BLOCK_KERNELS_H_
