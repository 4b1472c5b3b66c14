// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_METRIC_FUNCTIONS_H_
#define ICPSCAPE_SRC_OBJECTIVE_METRIC_FUNCTIONS_H_

#include <string>

#include "residuals/correspondence.h"

namespace ceres {
class CostFunction;
}  // namespace ceres

namespace icpscape {

/// What a registered metric is and does, behind values and pointers: where a metric's name turns
/// into its code.
struct MetricFunctions {
  unsigned needs;
  Epsilon epsilon;
  std::size_t place;  ///< In AllMetrics.
  /// One pair as a Ceres cost function over the seven parameters.
  ceres::CostFunction* (*make_cost)(const Correspondence& pair);
};

/// Throws UsageError for a metric that is not registered; the message lists those that are.
const MetricFunctions& MetricFunctionsOf(const std::string& metric);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_METRIC_FUNCTIONS_H_
