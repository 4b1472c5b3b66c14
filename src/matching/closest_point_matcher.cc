// SPDX-License-Identifier: BSD-3-Clause
#include "src/matching/closest_point_matcher.h"

#include <algorithm>
#include <limits>

#include "src/common/parallel.h"

namespace icpscape {

std::size_t Matches::Count() const {
  return static_cast<std::size_t>(
      std::count_if(target_index.begin(), target_index.end(), [](int j) { return j >= 0; }));
}

ClosestPointMatcher::ClosestPointMatcher(const PointCloud& source, const PointCloud& target,
                                         const MatchingOptions& options)
    : Matcher(source, target), options_(options), search_(target.View()) {
  if (options_.reciprocal_epsilon_m) {
    reciprocal_.emplace(source);
  }
}

void ClosestPointMatcher::Match(const SE3d& T, int threads, Matches* matches) const {
  constexpr std::size_t kChunk = 2048;
  const float gate = options_.max_distance_m > 0
                         ? static_cast<float>(options_.max_distance_m * options_.max_distance_m)
                         : std::numeric_limits<float>::max();
  matches->target_index.resize(source().size());
  ParallelFor((source().size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    const std::size_t end = std::min(source().size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      matches->target_index[i] = search_.Nearest(Query(T, source(), i), gate).index;
    }
  });
  if (reciprocal_) {
    reciprocal_->Reject(target(), T, *options_.reciprocal_epsilon_m, threads, matches);
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
