// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_
#define ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "src/matching/closest_point_matcher.h"
#include "src/matching/local_fit_matcher.h"
#include "src/objective/objective.h"

namespace icpscape::testing_support {

/// A matcher that provides what the metric needs, over all points of the source.
inline std::unique_ptr<Matcher> MatcherFor(const std::string& metric, const PointCloud& source,
                                           const PointCloud& target) {
  const unsigned needs = MetricFunctionsOf(metric).needs;
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

/// Pairs source point i with target point i at every pose, or with nothing where `unmatched` says
/// so, and all of them with one line or patch: what a metric makes of a pair can be computed by
/// hand.
class FixedMatcher final : public Matcher {
 public:
  FixedMatcher(const PointCloud& source, const PointCloud& target,
               const LocalFit& fit = {Vec3::Zero(), Vec3::UnitZ()}, double area = 0,
               std::vector<std::int32_t> unmatched = {})
      : Matcher(source, target), fit_(fit), area_(area), unmatched_(std::move(unmatched)) {}

  unsigned Provides() const override {
    return kSourceNormal | kTargetNormal | kTargetLine | kTargetPatch;
  }
  double area_patch() const override { return area_; }
  void MatchPart(const SE3d& /*T*/, std::size_t begin, std::size_t end,
                 Matches* matches) const override {
    matches->target_index.assign(Order().begin() + static_cast<std::ptrdiff_t>(begin),
                                 Order().begin() + static_cast<std::ptrdiff_t>(end));
    for (std::int32_t& index : matches->target_index) {
      if (std::find(unmatched_.begin(), unmatched_.end(), index) != unmatched_.end()) {
        index = -1;
      }
    }
    matches->fits.assign(end - begin, fit_);
  }

 private:
  LocalFit fit_;
  double area_;
  std::vector<std::int32_t> unmatched_;
};

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_
