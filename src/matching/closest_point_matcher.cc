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

ClosestPointMatcher::ClosestPointMatcher(const PointCloud& target, const MatchingOptions& options)
    : search_(target.View()),
      max_squared_distance_(options.max_distance_m > 0 ? static_cast<float>(options.max_distance_m *
                                                                            options.max_distance_m)
                                                       : std::numeric_limits<float>::max()) {}

void ClosestPointMatcher::Match(const PointCloud& source, const SE3d& T_target_source, int threads,
                                Matches* matches) const {
  constexpr std::size_t kChunk = 2048;
  matches->target_index.resize(source.size());
  ParallelFor((source.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    const std::size_t end = std::min(source.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const Eigen::Vector3f query = (T_target_source * source.Point(i)).cast<float>();
      matches->target_index[i] = search_.Nearest(query, max_squared_distance_).index;
    }
  });
}

}  // namespace icpscape
