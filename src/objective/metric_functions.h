// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_METRIC_FUNCTIONS_H_
#define ICPSCAPE_SRC_OBJECTIVE_METRIC_FUNCTIONS_H_

#include <string>

#include "src/objective/evaluation.h"
#include "src/objective/pair_block.h"

namespace ceres {
class CostFunction;
class LossFunction;
}  // namespace ceres

namespace icpscape {

/// What a registered metric is and does, behind function pointers: where a metric's name turns into
/// its code.
struct MetricFunctions {
  unsigned needs;
  Epsilon epsilon;
  /// Adds the sums over a block's pairs to `sums`; pairs that lack what the metric needs are left
  /// out. The loss may be null.
  void (*evaluate)(const PairBlock& block, const SE3d& T_target_source,
                   const ceres::LossFunction* loss, Derivatives derivatives, Evaluation* sums);
  /// One pair as a Ceres cost function over the seven parameters; null where it is left out.
  ceres::CostFunction* (*make_cost)(const PairBlock& block, std::size_t pair);
};

/// Throws UsageError for a metric that is not registered; the message lists those that are.
const MetricFunctions& MetricFunctionsOf(const std::string& metric);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_METRIC_FUNCTIONS_H_
