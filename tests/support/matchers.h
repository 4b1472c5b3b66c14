// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_
#define ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "icpscape/matching/matcher_kinds.h"
#include "icpscape/objective/objective.h"

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

 private:
  void FindPart(const SE3d& /*T*/, std::size_t begin, std::size_t end,
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

  LocalFit fit_;
  double area_;
  std::vector<std::int32_t> unmatched_;
};

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_MATCHERS_H_
