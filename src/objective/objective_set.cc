// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/objective_set.h"

#include "src/common/error.h"

namespace icpscape {

bool NeedsFeatures(const std::string& metric) {
  return (MetricFunctionsOf(metric).needs & (kTargetLine | kTargetPatch)) != 0;
}

ObjectiveSet::ObjectiveSet(const PointCloud& source, const PointCloud& target,
                           const Features& features, const std::vector<std::string>& metrics,
                           const ObjectiveSetOptions& options) {
  const SearchableCloud searchable_target(target, options.threads);
  for (const std::string& metric : metrics) {
    const Matcher& matcher = MatcherFor(metric, source, searchable_target, features, options);
    if (matcher.source().empty()) {
      throw ComputationError(metric + ": no source point is left for it; expected at least one.");
    }
    objectives_.emplace_back(metric, matcher, options.loss);
  }
}

const Matcher& ObjectiveSet::MatcherFor(const std::string& metric, const PointCloud& source,
                                        const SearchableCloud& target, const Features& features,
                                        const ObjectiveSetOptions& options) {
  const unsigned needs = MetricFunctionsOf(metric).needs;
  if ((needs & kTargetLine) != 0) {
    if (!lines_) {
      edges_ = std::make_unique<PointCloud>(source.Select(features.edge));
      lines_ = std::make_unique<LocalFitMatcher>(LocalFitMatcher::Shape::kLine, *edges_, target,
                                                 options.line);
    }
    return *lines_;
  }
  if ((needs & kTargetPatch) != 0) {
    if (!patches_) {
      planar_ = std::make_unique<PointCloud>(source.Select(features.planar));
      patches_ = std::make_unique<LocalFitMatcher>(LocalFitMatcher::Shape::kPatch, *planar_, target,
                                                   options.patch);
    }
    return *patches_;
  }
  if (!points_) {
    points_ = std::make_unique<ClosestPointMatcher>(SearchableCloud(source, options.threads),
                                                    target, options.matching);
  }
  return *points_;
}

}  // namespace icpscape
