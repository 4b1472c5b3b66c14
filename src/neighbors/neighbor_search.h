// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_NEIGHBORS_NEIGHBOR_SEARCH_H_
#define ICPSCAPE_SRC_NEIGHBORS_NEIGHBOR_SEARCH_H_

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "icpscape/neighbors/neighborhoods.h"
#include "icpscape/neighbors/points_view.h"

namespace icpscape {

/// A found point: its index and its squared distance to the query (m^2).
struct Neighbor {
  std::int32_t index = -1;
  float squared_distance = 0;
};

/// How many searches this process has built: each costs as much as matching a scan twice.
long SearchesBuilt();

/// Exact nearest neighbours among a fixed set of points, which is copied. Copies of the search
/// share them.
///
/// The squared distance is (dx*dx + dy*dy) + dz*dz in float without fused multiply-add, so that
/// every machine and every SIMD level finds the same neighbours; ties go to the lower index. A
/// point with a NaN or an infinity is never found, and such a query finds nothing. Safe to query
/// from many threads at once.
///
/// Batches are fast: queries are searched in packets, which pays where consecutive queries lie
/// close together, as points do in the Order() of their own search. See README.md.
class NeighborSearch {
 public:
  /// Results do not depend on `threads`, which only shortens the building.
  explicit NeighborSearch(const PointsView& points, int threads = 1);

  /// The nearest point; index -1 where there is none within max_squared_distance (inclusive).
  Neighbor Nearest(const Eigen::Vector3f& query, float max_squared_distance) const;

  /// The same for every query, into arrays of queries.size; squared_distance is defined only where
  /// an index was found.
  void Nearest(const PointsView& queries, float max_squared_distance, std::int32_t* index,
               float* squared_distance) const;

  /// The k nearest points (fewer if there are fewer), nearest first.
  void KNearest(const Eigen::Vector3f& query, int k, std::vector<Neighbor>* neighbors) const;

  /// The same for every query: k entries each, of index -1 where there are fewer.
  void KNearest(const PointsView& queries, int k, std::vector<Neighbor>* neighbors) const;

  /// All points within the radius (inclusive), nearest first.
  void WithinRadius(const Eigen::Vector3f& query, float radius_m,
                    std::vector<Neighbor>* neighbors) const;

  /// Moments of every query's k nearest points (fewer if there are fewer), or of all within a
  /// radius, without listing them: several times faster.
  void KNearest(const PointsView& queries, int k, Neighborhoods* neighborhoods) const;
  void WithinRadius(const PointsView& queries, float radius_m, Neighborhoods* neighborhoods) const;

  /// The indices of all finite points, such that what is near in space is near in the list.
  const std::vector<std::int32_t>& Order() const;
  /// The points in that order, padded; valid while a copy of this object lives.
  PointsView OrderedPoints() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_NEIGHBORS_NEIGHBOR_SEARCH_H_
