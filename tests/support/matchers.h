// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_
#define ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_

#include <memory>
#include <string>

#include "src/matching/closest_point_matcher.h"
#include "src/matching/local_fit_matcher.h"
#include "src/objective/objective.h"

namespace icpscape::testing_support {

/// A matcher that provides what the metric needs, over all points of the source.
inline std::unique_ptr<Matcher> MatcherFor(const std::string& metric, const PointCloud& source,
                                           const PointCloud& target) {
  const unsigned needs = MetricNamed(metric).needs;
  LocalFitOptions lenient;  // A synthetic room has few edges as sharp as the paper's rules want.
  lenient.eigenvalue_ratio = 1.5;
  lenient.max_smallest_eigenvalue_m2 = 1;
  if ((needs & kTargetLine) != 0) {
    return std::make_unique<LocalFitMatcher>(LocalFitMatcher::Shape::kLine, source, target,
                                             lenient);
  }
  if ((needs & kTargetPatch) != 0) {
    return std::make_unique<LocalFitMatcher>(LocalFitMatcher::Shape::kPatch, source, target,
                                             lenient);
  }
  return std::make_unique<ClosestPointMatcher>(source, target);
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_
