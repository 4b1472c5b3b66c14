// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MATCHING_CLOSEST_POINT_MATCHER_H_
#define ICPSCAPE_SRC_MATCHING_CLOSEST_POINT_MATCHER_H_

#include <optional>

#include "icpscape/matching/matcher.h"
#include "icpscape/matching/rejection.h"

namespace icpscape {

/// Which pairs take part. All of it is off by default, as in the paper's plain curves; what is on
/// is applied in this order.
struct MatchingOptions {
  /// Pairs further apart than this are not matched; 0 is no limit.
  double max_distance_m = 0;
  /// Only pairs whose q has p as its own closest point, up to this distance; 0 is strict
  /// [paper sec. 2.5; Pajdla & Van Gool 1995].
  std::optional<double> reciprocal_epsilon_m = std::nullopt;
  /// Only pairs whose normals enclose at most this angle; 0 is no limit.
  double max_normal_angle_rad = 0;
  /// Only pairs up to this multiple of the median distance; 0 is no limit.
  double max_median_factor = 0;
  /// Only this fraction of the pairs, the closest; 1 is all.
  double kept_fraction = 1;
  /// Drops large regions of the source whose mean distance stands out.
  std::optional<RegionOptions> regions = std::nullopt;

  /// Whether the number of pairs can change from pose to pose.
  bool Rejects() const {
    return max_distance_m > 0 || reciprocal_epsilon_m || max_normal_angle_rad > 0 ||
           max_median_factor > 0 || kept_fraction < 1 || regions;
  }
};

/// Closest-point correspondences p -> q [paper sec. 2]: for every source point the nearest target
/// point to T p, and then the rejections of the options.
class ClosestPointMatcher final : public Matcher {
 public:
  ClosestPointMatcher(SearchableCloud source, SearchableCloud target,
                      const MatchingOptions& options = {});

  /// All that clouds carry.
  static constexpr unsigned kProvides =
      NeedsFrom(Origin::kSourceCloud) | NeedsFrom(Origin::kTargetCloud);

  unsigned Provides() const override { return kProvides; }
  bool Rejects() const override;
  void Reject(const SE3d& T_target_source, int threads, Matches* matches) const override;

 private:
  void FindPart(const SE3d& T_target_source, std::size_t begin, std::size_t end,
                Matches* matches) const override;
  MatchingOptions options_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MATCHING_CLOSEST_POINT_MATCHER_H_
