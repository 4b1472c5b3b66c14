// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/objective_set.h"

#include "icpscape/common/error.h"

namespace icpscape {

bool NeedsFeatures(const std::string& metric) {
  return MatcherKindFor(MetricNamed(metric).needs).WorksOnFeatures();
}

unsigned NeedsOf(const std::vector<std::string>& metrics, const MatchingOptions& matching) {
  unsigned needs =
      matching.max_normal_angle_rad > 0 ? static_cast<unsigned>(kSourceNormal | kTargetNormal) : 0U;
  for (const std::string& metric : metrics) {
    needs |= MetricNamed(metric).needs;
  }
  return needs;
}

ObjectiveSet::ObjectiveSet(const PreparedPair& scans, const std::vector<std::string>& metrics,
                           const ObjectiveSetOptions& options)
    : ObjectiveSet(scans.source.clouds(), scans.target.AsTarget(), metrics, options) {}

ObjectiveSet::ObjectiveSet(const MetricClouds& source, const MetricClouds& target,
                           const std::vector<std::string>& metrics,
                           const ObjectiveSetOptions& options) {
  for (const std::string& name : metrics) {
    const RegisteredMetric& metric = MetricNamed(name);
    const Matcher& matcher = MatcherFor(metric, source, target, options);
    if (matcher.source().empty()) {
      throw ComputationError(name + ": no source point is left for it; expected at least one.");
    }
    objectives_.emplace_back(metric, matcher, options.loss);
  }
}

const Matcher& ObjectiveSet::MatcherFor(const RegisteredMetric& metric, const MetricClouds& source,
                                        const MetricClouds& target,
                                        const ObjectiveSetOptions& options) {
  const MatcherKind& kind = MatcherKindFor(metric.needs);
  const std::optional<SearchableCloud>& from = source.*kind.clouds;
  const std::optional<SearchableCloud>& to = target.*kind.clouds;
  if (!from || !to) {
    throw UsageError(metric.name + " needs clouds of " + kind.clouds_name +
                     "; expected them of both scans.");
  }
  std::unique_ptr<Matcher>& matcher = matchers_[&kind];
  if (!matcher) {
    matcher = kind.make(*from, *to, options);
  }
  return *matcher;
}

}  // namespace icpscape
