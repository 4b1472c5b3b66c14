// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_
#define ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_

#include <memory>
#include <string>

#include "src/matching/matcher_kinds.h"
#include "src/objective/objective.h"

namespace icpscape::testing_support {

/// A matcher that provides what the metric needs, over all points of the source.
inline std::unique_ptr<Matcher> MatcherFor(const std::string& metric, const PointCloud& source,
                                           const PointCloud& target) {
  const MatcherKind& kind = MatcherKindFor(MetricNamed(metric).needs);
  MatcherOptions lenient;  // A synthetic room has few edges as sharp as the paper's rules want.
  for (LocalFitOptions* fit : {&lenient.line, &lenient.patch}) {
    fit->eigenvalue_ratio = 1.5;
    fit->max_smallest_eigenvalue_m2 = 1;
  }
  return kind.make(source, target, lenient);
}

/// The pair of the i-th source point, which has a match, by hand from clouds and fits: what an
/// objective must hand to its metric.
inline Correspondence PairByHand(const Matcher& matcher, const Matches& matches, std::size_t i) {
  const auto j = static_cast<std::size_t>(matches.target_index[i]);
  Correspondence c;
  c.p_source = matcher.source().Point(i);
  c.q_target = matcher.target().Point(j);
  c.R_matched = matches.T_target_source.R();
  if (matcher.source().has_normals()) {
    c.n_source = matcher.source().Normal(i);
  }
  if (matcher.target().has_normals()) {
    c.n_target = matcher.target().Normal(j);
  }
  if (!matches.fits.empty()) {
    c.a_line = c.q_patch = matches.fits[i].anchor;
    c.d_line = c.n_patch = matches.fits[i].direction;
    c.area_patch = matcher.area_patch();
  }
  return c;
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_
