// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/matcher_kinds.h"

#include <glog/logging.h>

#include <algorithm>

namespace icpscape {
namespace {

std::unique_ptr<Matcher> MakeClosestPoint(const SearchableCloud& source,
                                          const SearchableCloud& target,
                                          const MatcherOptions& options) {
  return std::make_unique<ClosestPointMatcher>(source, target, options.matching);
}

using Shape = LocalFitMatcher::Shape;

template <Shape kShape, LocalFitOptions MatcherOptions::*kOptions>
std::unique_ptr<Matcher> MakeLocalFit(const SearchableCloud& source, const SearchableCloud& target,
                                      const MatcherOptions& options) {
  return std::make_unique<LocalFitMatcher>(kShape, source, target, options.*kOptions);
}

}  // namespace

const std::vector<MatcherKind>& AllMatcherKinds() {
  static const std::vector<MatcherKind> kinds = {
      {ClosestPointMatcher::kProvides, &MetricClouds::points, "points", &MakeClosestPoint},
      {LocalFitMatcher::ProvidedBy(Shape::kLine), &MetricClouds::edges, "edges",
       &MakeLocalFit<Shape::kLine, &MatcherOptions::line>},
      {LocalFitMatcher::ProvidedBy(Shape::kPatch), &MetricClouds::planar, "planar points",
       &MakeLocalFit<Shape::kPatch, &MatcherOptions::patch>},
  };
  return kinds;
}

const MatcherKind& MatcherKindFor(unsigned needs) {
  const std::vector<MatcherKind>& kinds = AllMatcherKinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [needs](const MatcherKind& candidate) {
    return (needs & ~candidate.provides) == 0;
  });
  CHECK(kind != kinds.end()) << "no matcher provides " << NeedsText(needs);
  return *kind;
}

}  // namespace icpscape
