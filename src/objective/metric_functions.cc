// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/metric_functions.h"

#include <vector>

#include "residuals/adapters/ceres.h"
#include "residuals/registry.h"
#include "src/common/error.h"
#include "src/common/text.h"

namespace icpscape {
namespace {

template <class Metric>
ceres::CostFunction* MakeCost(const Correspondence& pair) {
  return new CeresCost<Metric>(Metric::From(pair));
}

std::vector<std::pair<std::string, MetricFunctions>> AllFunctions() {
  std::vector<std::pair<std::string, MetricFunctions>> all;
  ForEachMetric([&](auto tag) {
    using Metric = typename decltype(tag)::Metric;
    all.emplace_back(Metric::kName, MetricFunctions{Metric::kNeeds, Metric::kEpsilon, all.size(),
                                                    &MakeCost<Metric>});
  });
  return all;
}

}  // namespace

const MetricFunctions& MetricFunctionsOf(const std::string& metric) {
  static const auto all = AllFunctions();
  std::vector<std::string> known;
  for (const auto& [name, functions] : all) {
    if (name == metric) {
      return functions;
    }
    known.push_back(name);
  }
  throw UsageError("unknown metric \"" + metric + "\": expected one of " + Join(known) + ".");
}

}  // namespace icpscape
