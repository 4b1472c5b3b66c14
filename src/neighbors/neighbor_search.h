// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_NEIGHBORS_NEIGHBOR_SEARCH_H_
#define ICPSCAPE_SRC_NEIGHBORS_NEIGHBOR_SEARCH_H_

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

namespace icpscape {

/// A found point: its index and its squared distance to the query (m^2).
struct Neighbor {
  std::int32_t index = -1;
  float squared_distance = 0;
};

/// Three arrays of equal length; the caller keeps them alive. All values finite.
struct PointsView {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t size = 0;
};

/// Exact nearest neighbours among a fixed set of points.
///
/// The squared distance is (dx*dx + dy*dy) + dz*dz in float without fused multiply-add, so that
/// every machine finds the same neighbours; ties go to the lower index. Safe to query from many
/// threads at once.
class NeighborSearch {
 public:
  explicit NeighborSearch(const PointsView& points);
  ~NeighborSearch();
  NeighborSearch(NeighborSearch&&) noexcept;
  NeighborSearch& operator=(NeighborSearch&&) noexcept;

  /// The nearest point; index -1 where there is none within max_squared_distance (inclusive).
  Neighbor Nearest(const Eigen::Vector3f& query, float max_squared_distance) const;

  /// The k nearest points (fewer if there are fewer), nearest first.
  void KNearest(const Eigen::Vector3f& query, int k, std::vector<Neighbor>* neighbors) const;

  /// All points within the radius (inclusive), nearest first.
  void WithinRadius(const Eigen::Vector3f& query, float radius_m,
                    std::vector<Neighbor>* neighbors) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_NEIGHBORS_NEIGHBOR_SEARCH_H_
