// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_NANOFLANN_PEER_H_
#define ICPSCAPE_TESTS_BENCHMARKS_NANOFLANN_PEER_H_

#include <cstdint>
#include <nanoflann.hpp>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/common/parallel.h"
#include "tests/benchmarks/nearest.h"

namespace icpscape {

/// nanoflann as its examples use it: float, leaves of 10 points, points in three arrays.
class NanoflannTree {
 public:
  /// The cloud must outlive the tree.
  explicit NanoflannTree(const PointCloud& cloud) : adaptor_{&cloud}, tree_(3, adaptor_, {10}) {}

  void Nearest(const float query[3], std::int32_t* index, float* squared_distance) const {
    tree_.knnSearch(query, 1, index, squared_distance);
  }

  void Nearest(const PointCloud& queries, int threads, NearestResult* result) const {
    constexpr std::size_t kChunk = 4096;
    ParallelFor((queries.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
      const std::size_t end = std::min(queries.size(), (chunk + 1) * kChunk);
      for (std::size_t i = chunk * kChunk; i < end; ++i) {
        const float query[3] = {queries.x[i], queries.y[i], queries.z[i]};
        Nearest(query, &result->index[i], &result->squared_distance[i]);
      }
    });
  }

 private:
  struct Adaptor {
    const PointCloud* cloud;
    std::size_t kdtree_get_point_count() const { return cloud->size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return axis == 0 ? cloud->x[i] : axis == 1 ? cloud->y[i] : cloud->z[i];
    }
    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const {
      return false;
    }
  };
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Adaptor>,
                                                   Adaptor, 3, std::int32_t>;
  Adaptor adaptor_;
  Tree tree_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_NANOFLANN_PEER_H_
