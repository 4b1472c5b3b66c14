// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_BLOCK_KERNELS_H_
#define ICPSCAPE_SRC_OBJECTIVE_BLOCK_KERNELS_H_

#include <cstddef>

#include "src/simd/level.h"

namespace icpscape {

constexpr std::size_t kBlockPairs = 128;

/// A block of pairs, value by value side by side. Arrays can be read in eights, also behind the
/// last pair; what is there is finite.
struct BlockValues {
  double anchor[3][kBlockPairs];     ///< Of a fitted line or patch.
  double direction[3][kBlockPairs];  ///< The line's direction or the patch's normal.
  float q_target[3][kBlockPairs];
  float n_target[3][kBlockPairs];  ///< 0 0 0 for a point without a normal, as in n_source.
  float matched[kBlockPairs];      ///< 1 for a pair, 0 for a source point without a match.
  const float* p_source[3];
  const float* n_source[3];
  double area_patch;
  std::size_t size;
};

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
