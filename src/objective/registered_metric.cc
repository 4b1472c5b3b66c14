// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/registered_metric.h"

#include <vector>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/residuals/adapters/ceres.h"
#include "icpscape/residuals/registry.h"

namespace icpscape {
namespace {

template <class Metric>
ceres::CostFunction* MakeCost(const Correspondence& pair) {
  return new CeresCost<Metric>(Metric::From(pair));
}

std::vector<RegisteredMetric> RegisterAll() {
  std::vector<RegisteredMetric> all;
  ForEachMetric([&](auto tag) {
    using Metric = typename decltype(tag)::Metric;
    all.push_back({Metric::kName, Metric::kNeeds, Metric::kEpsilon, all.size(), &MakeCost<Metric>});
  });
  return all;
}

}  // namespace

const RegisteredMetric& MetricNamed(const std::string& name) {
  // Never destroyed: handles may be used until the end of the program.
  static const auto& all = *new std::vector<RegisteredMetric>(RegisterAll());
  std::vector<std::string> known;
  for (const RegisteredMetric& metric : all) {
    if (metric.name == name) {
      return metric;
    }
    known.push_back(metric.name);
  }
  throw UsageError("unknown metric \"" + name + "\": expected one of " + Join(known) + ".");
}

}  // namespace icpscape
