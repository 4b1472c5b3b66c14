// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/objective_set.h"

#include <glog/logging.h>

#include "src/common/error.h"

namespace icpscape {
namespace {

bool NeedsLine(const std::string& metric) {
  return (MetricFunctionsOf(metric).needs & kTargetLine) != 0;
}
bool NeedsPatch(const std::string& metric) {
  return (MetricFunctionsOf(metric).needs & kTargetPatch) != 0;
}

}  // namespace

bool NeedsFeatures(const std::string& metric) { return NeedsLine(metric) || NeedsPatch(metric); }

unsigned NeedsOf(const std::vector<std::string>& metrics, const MatchingOptions& matching) {
  unsigned needs =
      matching.max_normal_angle_rad > 0 ? static_cast<unsigned>(kSourceNormal | kTargetNormal) : 0U;
  for (const std::string& metric : metrics) {
    needs |= MetricFunctionsOf(metric).needs;
  }
  return needs;
}

ObjectiveSet::ObjectiveSet(const PreparedPair& scans, const std::vector<std::string>& metrics,
                           const ObjectiveSetOptions& options)
    : ObjectiveSet(scans.source.clouds(), scans.target.AsTarget(), metrics, options) {}

ObjectiveSet::ObjectiveSet(const MetricClouds& source, const MetricClouds& target,
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
