// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MATCHING_CLOSEST_POINT_MATCHER_H_
#define ICPSCAPE_SRC_MATCHING_CLOSEST_POINT_MATCHER_H_

#include <cstdint>
#include <vector>

#include "src/cloud/point_cloud.h"
#include "src/neighbors/neighbor_search.h"

namespace icpscape {

/// The match of each source point: its index in the target, or -1 where there is none.
struct Matches {
  std::vector<std::int32_t> target_index;

  std::size_t Count() const;
};

struct MatchingOptions {
  /// Pairs further apart than this are not matched; 0 switches the gate off, as in the paper.
  double max_distance_m = 0;
};

/// Closest-point correspondences p -> q [paper sec. 2]: for every source point the nearest target
/// point to T p.
class ClosestPointMatcher {
 public:
  /// The cloud must outlive the matcher.
  explicit ClosestPointMatcher(const PointCloud& target, const MatchingOptions& options = {});

  /// Matches every source point at the pose; the result does not depend on `threads`. The point is
  /// moved in double and rounded to float once, for the search.
  void Match(const PointCloud& source, const SE3d& T_target_source, int threads,
             Matches* matches) const;

 private:
  NeighborSearch search_;
  float max_squared_distance_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MATCHING_CLOSEST_POINT_MATCHER_H_
