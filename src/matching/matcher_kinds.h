// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MATCHING_MATCHER_KINDS_H_
#define ICPSCAPE_SRC_MATCHING_MATCHER_KINDS_H_

#include <memory>
#include <optional>
#include <vector>

#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/matching/local_fit_matcher.h"
#include "icpscape/matching/metric_clouds.h"

namespace icpscape {

/// How the matchers of all kinds are set up.
struct MatcherOptions {
  MatchingOptions matching;  ///< Of closest points.
  LocalFitOptions line;      ///< Of lines through edge points.
  LocalFitOptions patch;     ///< Of patches through planar points.
};

/// A kind of matcher: metrics find theirs by what it provides.
struct MatcherKind {
  /// Union of Needs.
  unsigned provides;
  /// Which points of a scan it works on, and what they are called.
  std::optional<SearchableCloud> MetricClouds::*clouds;
  const char* clouds_name;
  std::unique_ptr<Matcher> (*make)(const SearchableCloud& source, const SearchableCloud& target,
                                   const MatcherOptions& options);

  /// Whether it works on edge or planar points, which must be extracted first.
  bool WorksOnFeatures() const { return clouds != &MetricClouds::points; }
};

const std::vector<MatcherKind>& AllMatcherKinds();

/// The first kind that provides all of `needs`, a union of Needs (CHECKed).
const MatcherKind& MatcherKindFor(unsigned needs);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MATCHING_MATCHER_KINDS_H_
