// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_REGISTERED_METRIC_H_
#define ICPSCAPE_SRC_OBJECTIVE_REGISTERED_METRIC_H_

#include <cstddef>
#include <string>

#include "icpscape/residuals/correspondence.h"

namespace ceres {
class CostFunction;
}  // namespace ceres

namespace icpscape {

/// What a registered metric is and does, behind values and pointers. There is one of each, which
/// never changes and is never destroyed: a reference to it is the handle by which a metric travels,
/// from where its name is read to where its code runs.
struct RegisteredMetric {
  std::string name;
  unsigned needs;
  Epsilon epsilon;
  std::size_t place;  ///< In AllMetrics, and in every table of code that has a row per metric.
  /// One pair as a Ceres cost function over the seven parameters.
  ceres::CostFunction* (*make_cost)(const Correspondence& pair);
};

/// Throws UsageError for a metric that is not registered; the message lists those that are.
const RegisteredMetric& MetricNamed(const std::string& name);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_REGISTERED_METRIC_H_
