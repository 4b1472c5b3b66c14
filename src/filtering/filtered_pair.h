// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_FILTERING_FILTERED_PAIR_H_
#define ICPSCAPE_SRC_FILTERING_FILTERED_PAIR_H_

#include <utility>
#include <vector>

#include "src/cloud/point_cloud.h"

namespace icpscape {

/// What a filter leaves of a pair of scans. Filters select: every kept point has the coordinates it
/// came with, in its own frame, and the points stay in order.
struct FilteredPair {
  PointCloud source;
  PointCloud target;
  std::vector<char> keep_source;  ///< One entry per point of the source that came in: 1 is kept.
  std::vector<char> keep_target;
};

inline FilteredPair SelectPair(const PointCloud& source, const PointCloud& target,
                               std::vector<char> keep_source, std::vector<char> keep_target) {
  FilteredPair pair;
  pair.source = source.Select(keep_source);
  pair.target = target.Select(keep_target);
  pair.keep_source = std::move(keep_source);
  pair.keep_target = std::move(keep_target);
  return pair;
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_FILTERING_FILTERED_PAIR_H_
