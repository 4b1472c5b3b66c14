// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/objective_set.h"

#include <glog/logging.h>

#include "src/common/error.h"

namespace icpscape {
namespace {

bool NeedsLine(const std::string& metric) {
  return (MetricNamed(metric).needs & kTargetLine) != 0;
}
bool NeedsPatch(const std::string& metric) {
  return (MetricNamed(metric).needs & kTargetPatch) != 0;
}

}  // namespace

bool NeedsFeatures(const std::string& metric) { return NeedsLine(metric) || NeedsPatch(metric); }

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
  for (const std::string& metric : metrics) {
    const Matcher& matcher = MatcherFor(metric, source, target, options);
    if (matcher.source().empty()) {
      throw ComputationError(metric + ": no source point is left for it; expected at least one.");
    }
    objectives_.emplace_back(metric, matcher, options.loss);
  }
}

const Matcher& ObjectiveSet::MatcherFor(const std::string& metric, const MetricClouds& source,
                                        const MetricClouds& target,
                                        const ObjectiveSetOptions& options) {
  if (NeedsLine(metric)) {
    CHECK(source.edges && target.edges) << metric << " needs clouds of edges";
    if (!lines_) {
      lines_ = std::make_unique<LocalFitMatcher>(LocalFitMatcher::Shape::kLine, *source.edges,
                                                 *target.edges, options.line);
    }
    return *lines_;
  }
  if (NeedsPatch(metric)) {
    CHECK(source.planar && target.planar) << metric << " needs clouds of planar points";
    if (!patches_) {
      patches_ = std::make_unique<LocalFitMatcher>(LocalFitMatcher::Shape::kPatch, *source.planar,
                                                   *target.planar, options.patch);
    }
    return *patches_;
  }
  CHECK(source.points && target.points) << metric << " needs clouds of points";
  if (!points_) {
    points_ =
        std::make_unique<ClosestPointMatcher>(*source.points, *target.points, options.matching);
  }
  return *points_;
}

}  // namespace icpscape
