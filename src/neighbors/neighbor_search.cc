// SPDX-License-Identifier: BSD-3-Clause
#include "src/neighbors/neighbor_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>

namespace icpscape {
namespace {

struct Adaptor {
  PointsView points;

  std::size_t kdtree_get_point_count() const { return points.size; }
  float kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return axis == 0 ? points.x[index] : axis == 1 ? points.y[index] : points.z[index];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Adaptor>,
                                                 Adaptor, 3, std::int32_t>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool Before(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance < b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.index < b.index);
}

// The result sets below answer worstDist() with the next larger float: the tree skips what is not
// below that, and a point at an equal distance must still be seen, in case its index is lower.

class NearestSet {
 public:
  using DistanceType = float;
  explicit NearestSet(float limit) { best_.squared_distance = limit; }
  std::size_t size() const { return best_.index >= 0 ? 1 : 0; }
  bool full() const { return true; }
  float worstDist() const { return std::nextafter(best_.squared_distance, kInfinity); }
  bool addPoint(float distance, std::int32_t index) {
    const Neighbor candidate{index, distance};
    if (distance <= best_.squared_distance && (best_.index < 0 || Before(candidate, best_))) {
      best_ = candidate;
    }
    return true;
  }
  const Neighbor& best() const { return best_; }

 private:
  Neighbor best_;
};

class KNearestSet {
 public:
  using DistanceType = float;
  KNearestSet(std::size_t k, std::vector<Neighbor>* out) : k_(k), out_(out) { out_->clear(); }
  std::size_t size() const { return out_->size(); }
  bool full() const { return size() == k_; }
  float worstDist() const {
    return full() ? std::nextafter(out_->back().squared_distance, kInfinity) : kInfinity;
  }
  bool addPoint(float distance, std::int32_t index) {
    const Neighbor candidate{index, distance};
    if (full()) {
      if (!Before(candidate, out_->back())) {
        return true;
      }
      out_->pop_back();
    }
    out_->insert(std::upper_bound(out_->begin(), out_->end(), candidate, Before), candidate);
    return true;
  }

 private:
  std::size_t k_;
  std::vector<Neighbor>* out_;
};

class RadiusSet {
 public:
  using DistanceType = float;
  RadiusSet(float squared_radius, std::vector<Neighbor>* out)
      : squared_radius_(squared_radius), out_(out) {
    out_->clear();
  }
  std::size_t size() const { return out_->size(); }
  bool full() const { return true; }
  float worstDist() const { return std::nextafter(squared_radius_, kInfinity); }
  bool addPoint(float distance, std::int32_t index) {
    if (distance <= squared_radius_) {
      out_->push_back({index, distance});
    }
    return true;
  }

 private:
  float squared_radius_;
  std::vector<Neighbor>* out_;
};

}  // namespace

struct NeighborSearch::Impl {
  explicit Impl(const PointsView& points)
      : adaptor{points}, tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {}

  template <class Set>
  void Find(const Eigen::Vector3f& query, Set* set) const {
    if (adaptor.points.size > 0) {
      tree.findNeighbors(*set, query.data(), nanoflann::SearchParams());
    }
  }

  Adaptor adaptor;
  Tree tree;
};

NeighborSearch::NeighborSearch(const PointsView& points) : impl_(std::make_unique<Impl>(points)) {}
NeighborSearch::~NeighborSearch() = default;
NeighborSearch::NeighborSearch(NeighborSearch&&) noexcept = default;
NeighborSearch& NeighborSearch::operator=(NeighborSearch&&) noexcept = default;

Neighbor NeighborSearch::Nearest(const Eigen::Vector3f& query, float max_squared_distance) const {
  NearestSet set(max_squared_distance);
  impl_->Find(query, &set);
  return set.best();
}

void NeighborSearch::KNearest(const Eigen::Vector3f& query, int k,
                              std::vector<Neighbor>* neighbors) const {
  KNearestSet set(static_cast<std::size_t>(std::max(k, 1)), neighbors);
  impl_->Find(query, &set);
}

void NeighborSearch::WithinRadius(const Eigen::Vector3f& query, float radius_m,
                                  std::vector<Neighbor>* neighbors) const {
  RadiusSet set(radius_m * radius_m, neighbors);
  impl_->Find(query, &set);
  std::sort(neighbors->begin(), neighbors->end(), Before);
}

}  // namespace icpscape
