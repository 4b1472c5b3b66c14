// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/closest_point_matcher.h"

#include <limits>
#include <utility>
#include <vector>

#include "icpscape/neighbors/moved_points.h"

namespace icpscape {

ClosestPointMatcher::ClosestPointMatcher(SearchableCloud source, SearchableCloud target,
                                         const MatchingOptions& options)
    : Matcher(std::move(source), std::move(target)), options_(options) {}

void ClosestPointMatcher::FindPart(const SE3d& T, std::size_t begin, std::size_t end,
                                   Matches* matches) const {
  const float gate = options_.max_distance_m > 0
                         ? static_cast<float>(options_.max_distance_m * options_.max_distance_m)
                         : std::numeric_limits<float>::max();
  thread_local MovedPoints moved;
  thread_local std::vector<float> squared_distance;
  moved.Move(T, searchable_source().search().OrderedPoints().Slice(begin, end));
  matches->target_index.resize(end - begin);
  squared_distance.resize(end - begin);
  searchable_target().search().Nearest(moved.View(), gate, matches->target_index.data(),
                                       squared_distance.data());
}

bool ClosestPointMatcher::Rejects() const {
  MatchingOptions without_gate = options_;
  without_gate.max_distance_m = 0;
  return without_gate.Rejects();
}

void ClosestPointMatcher::Reject(const SE3d& T, int threads, Matches* matches) const {
  if (options_.reciprocal_epsilon_m) {
    RejectNotReciprocal(searchable_source(), target(), T, *options_.reciprocal_epsilon_m, threads,
                        matches);
  }
  if (options_.max_normal_angle_rad > 0) {
    RejectByNormalAngle(source(), target(), T, options_.max_normal_angle_rad, matches);
  }
  if (options_.max_median_factor > 0) {
    RejectBeyondMedian(source(), target(), T, options_.max_median_factor, matches);
  }
  if (options_.kept_fraction < 1) {
    RejectTrimmed(source(), target(), T, options_.kept_fraction, matches);
  }
  if (options_.regions) {
    RejectRegions(source(), target(), T, *options_.regions, matches);
  }
}

}  // namespace icpscape
