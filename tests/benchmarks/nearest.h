// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_NEAREST_H_
#define ICPSCAPE_TESTS_BENCHMARKS_NEAREST_H_

#include <cstdint>
#include <vector>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/neighbors/neighbor_search.h"

namespace icpscape {

/// One entry per query.
struct NearestResult {
  std::vector<std::int32_t> index;
  std::vector<float> squared_distance;

  explicit NearestResult(std::size_t size = 0) : index(size), squared_distance(size) {}
};

/// Every query's nearest point, by this library's batch search on `threads` threads.
void NearestOfAll(const NeighborSearch& search, const PointCloud& queries, int threads,
                  NearestResult* result);
NearestResult NearestOfAll(const NeighborSearch& search, const PointCloud& queries);

/// Coordinates in that order.
PointCloud Reordered(const PointCloud& cloud, const std::vector<std::int32_t>& order);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_NEAREST_H_
