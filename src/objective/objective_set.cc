// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/objective_set.h"

#include <glog/logging.h>

#include "src/common/error.h"

namespace icpscape {
namespace {

bool NeedsLine(const std::string& metric) { return (MetricNamed(metric).needs & kTargetLine) != 0; }
bool NeedsPatch(const std::string& metric) {
  return (MetricNamed(metric).needs & kTargetPatch) != 0;
}

}  // namespace

bool NeedsFeatures(const std::string& metric) {
  return MatcherKindFor(MetricNamed(metric).needs).WorksOnFeatures();
}

ObjectiveSet::ObjectiveSet(const PointCloud& source, const PointCloud& target,
                           const Features& features, const std::vector<std::string>& metrics,
                           const ObjectiveSetOptions& options) {
  const SearchableCloud all(target, options.threads);
  MetricClouds sources;
  for (const std::string& metric : metrics) {
    if (NeedsLine(metric)) {
      if (!edges_) {
        edges_ = std::make_unique<PointCloud>(source.Select(features.edge));
        sources.edges.emplace(*edges_, options.threads);
      }
    } else if (NeedsPatch(metric)) {
      if (!planar_) {
        planar_ = std::make_unique<PointCloud>(source.Select(features.planar));
        sources.planar.emplace(*planar_, options.threads);
      }
    } else if (!sources.points) {
      sources.points.emplace(source, options.threads);
    }
  }
  AddObjectives(sources, {all, all, all}, metrics, options);
}

ObjectiveSet::ObjectiveSet(const MetricClouds& source, const MetricClouds& target,
                           const std::vector<std::string>& metrics,
                           const ObjectiveSetOptions& options) {
  AddObjectives(source, target, metrics, options);
}

void ObjectiveSet::AddObjectives(const MetricClouds& source, const MetricClouds& target,
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
  CHECK(from && to) << metric.name << " needs clouds of " << kind.clouds_name;
  std::unique_ptr<Matcher>& matcher = matchers_[&kind];
  if (!matcher) {
    matcher = kind.make(*from, *to, options);
  }
  return *matcher;
}

}  // namespace icpscape
