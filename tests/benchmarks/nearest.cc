// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/nearest.h"

#include <algorithm>
#include <limits>

#include "icpscape/common/parallel.h"

namespace icpscape {

void NearestOfAll(const NeighborSearch& search, const PointCloud& queries, int threads,
                  NearestResult* result) {
  constexpr std::size_t kChunk = 4096;
  ParallelFor((queries.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kChunk;
    const PointsView part = {queries.x.data() + begin, queries.y.data() + begin,
                             queries.z.data() + begin, std::min(kChunk, queries.size() - begin)};
    search.Nearest(part, std::numeric_limits<float>::max(), result->index.data() + begin,
                   result->squared_distance.data() + begin);
  });
}

NearestResult NearestOfAll(const NeighborSearch& search, const PointCloud& queries) {
  NearestResult result(queries.size());
  NearestOfAll(search, queries, 1, &result);
  return result;
}

PointCloud Reordered(const PointCloud& cloud, const std::vector<std::int32_t>& order) {
  PointCloud out;
  out.x.reserve(order.size());
  out.y.reserve(order.size());
  out.z.reserve(order.size());
  for (const std::int32_t index : order) {
    const auto i = static_cast<std::size_t>(index);
    out.x.push_back(cloud.x[i]);
    out.y.push_back(cloud.y[i]);
    out.z.push_back(cloud.z[i]);
  }
  return out;
}

}  // namespace icpscape
