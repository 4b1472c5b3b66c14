// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/neighbors/neighbor_search.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "icpscape/neighbors/kd_tree.h"
#include "icpscape/neighbors/search_kernels.h"

namespace icpscape {
namespace {

std::atomic<long> searches_built = 0;

constexpr float kNoLimit = std::numeric_limits<float>::max();

PointsView One(const Eigen::Vector3f& query) {
  return {query.data(), query.data() + 1, query.data() + 2, 1};
}

// Room that a thread keeps from call to call.
struct Scratch {
  struct alignas(64) Vector {
    float lanes[kWidestVector];
  };
  std::vector<Vector> vectors;
  std::vector<std::int32_t> points;
  std::vector<std::int32_t> index;
  std::vector<float> squared_distance;

  float* Floats(int k) {
    const std::size_t needed = ScratchFloats(std::max(k, 1)) / kWidestVector;
    if (vectors.size() < needed) {
      vectors.resize(needed);
    }
    return vectors.data()->lanes;
  }
  std::int32_t* Points(const KdTreeView& tree) {
    const auto needed = static_cast<std::size_t>(tree.num_points) + 1;
    if (points.size() < needed) {
      points.resize(needed);
    }
    return points.data();
  }
};

Scratch& ThisThreadsScratch() {
  thread_local Scratch scratch;
  return scratch;
}

MomentsView View(Neighborhoods* n) {
  return {n->count.data(), n->nearest.data(), n->farthest_squared_distance.data(),
          n->x.data(),     n->y.data(),       n->z.data(),
          n->xx.data(),    n->xy.data(),      n->xz.data(),
          n->yy.data(),    n->yz.data(),      n->zz.data()};
}

}  // namespace

struct NeighborSearch::Impl {
  Impl(const PointsView& points, int threads)
      : tree(points, threads), kernels(SearchKernelsAt(ActiveSimdLevel())) {
    ++searches_built;
  }

  void Moments(const PointsView& queries, int k, float limit, Neighborhoods* out) const {
    const KdTreeView view = tree.View();
    Scratch& scratch = ThisThreadsScratch();
    out->Resize(queries.size);
    kernels.moments(view, queries, k, limit, scratch.Floats(std::min(k, view.num_points)),
                    scratch.Points(view), View(out));
  }

  KdTree tree;
  const SearchKernels& kernels;
};

long SearchesBuilt() { return searches_built; }

NeighborSearch::NeighborSearch(const PointsView& points, int threads)
    : impl_(std::make_shared<const Impl>(points, threads)) {}

const std::vector<std::int32_t>& NeighborSearch::Order() const { return impl_->tree.index(); }

PointsView NeighborSearch::OrderedPoints() const {
  const KdTreeView tree = impl_->tree.View();
  return {tree.x, tree.y, tree.z, static_cast<std::size_t>(tree.num_points)};
}

void NeighborSearch::Nearest(const PointsView& queries, float max_squared_distance,
                             std::int32_t* index, float* squared_distance) const {
  impl_->kernels.nearest(impl_->tree.View(), queries, std::min(max_squared_distance, kNoLimit),
                         index, squared_distance);
}

Neighbor NeighborSearch::Nearest(const Eigen::Vector3f& query, float max_squared_distance) const {
  Neighbor found;
  Nearest(One(query), max_squared_distance, &found.index, &found.squared_distance);
  return found.index < 0 ? Neighbor() : found;
}

void NeighborSearch::KNearest(const PointsView& queries, int k,
                              std::vector<Neighbor>* neighbors) const {
  k = std::max(k, 1);
  const std::size_t size = queries.size * static_cast<std::size_t>(k);
  Scratch& scratch = ThisThreadsScratch();
  scratch.index.resize(size);
  scratch.squared_distance.resize(size);
  impl_->kernels.k_nearest(impl_->tree.View(), queries, k, kNoLimit, scratch.Floats(k),
                           scratch.index.data(), scratch.squared_distance.data());
  neighbors->resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    (*neighbors)[i] = {scratch.index[i], scratch.squared_distance[i]};
  }
}

void NeighborSearch::KNearest(const Eigen::Vector3f& query, int k,
                              std::vector<Neighbor>* neighbors) const {
  KNearest(One(query), std::min(k, std::max(impl_->tree.View().num_points, 1)), neighbors);
  while (!neighbors->empty() && neighbors->back().index < 0) {
    neighbors->pop_back();
  }
}

void NeighborSearch::WithinRadius(const Eigen::Vector3f& query, float radius_m,
                                  std::vector<Neighbor>* neighbors) const {
  const float limit = std::min(radius_m * radius_m, kNoLimit);
  const KdTreeView tree = impl_->tree.View();
  std::int32_t* const points = ThisThreadsScratch().Points(tree);
  const std::int32_t found = impl_->kernels.within(tree, One(query), limit, points);
  neighbors->clear();
  for (std::int32_t i = 0; i < found; ++i) {
    const float dx = query.x() - tree.x[points[i]];
    const float dy = query.y() - tree.y[points[i]];
    const float dz = query.z() - tree.z[points[i]];
    neighbors->push_back({tree.index[points[i]], (dx * dx + dy * dy) + dz * dz});
  }
  std::sort(neighbors->begin(), neighbors->end(), [](const Neighbor& a, const Neighbor& b) {
    return a.squared_distance < b.squared_distance ||
           (a.squared_distance == b.squared_distance && a.index < b.index);
  });
}

void NeighborSearch::KNearest(const PointsView& queries, int k,
                              Neighborhoods* neighborhoods) const {
  impl_->Moments(queries, std::max(k, 1), kNoLimit, neighborhoods);
}

void NeighborSearch::WithinRadius(const PointsView& queries, float radius_m,
                                  Neighborhoods* neighborhoods) const {
  impl_->Moments(queries, 0, std::min(radius_m * radius_m, kNoLimit), neighborhoods);
}

}  // namespace icpscape
