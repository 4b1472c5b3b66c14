// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_NEIGHBORS_SEARCH_KERNELS_H_
#define ICPSCAPE_SRC_NEIGHBORS_SEARCH_KERNELS_H_

#include <cstddef>
#include <cstdint>

#include "icpscape/neighbors/kd_tree_view.h"
#include "icpscape/neighbors/points_view.h"
#include "icpscape/simd/level.h"

namespace icpscape {

/// Where the moments of each query's neighbours go, one array entry per query. Coordinates are
/// relative to the query.
struct MomentsView {
  std::int32_t* count;                  ///< How many neighbours there are.
  std::int32_t* nearest;                ///< The nearest one's index, -1 where there is none.
  float* farthest;                      ///< The farthest one's squared distance (m^2).
  double *x, *y, *z;                    ///< Sums (m).
  double *xx, *xy, *xz, *yy, *yz, *zz;  ///< Sums of products (m^2).
};

/// Symmetric 3x3 matrices in, their eigenvalues and two of their eigenvectors out.
struct EigenView {
  const double *xx, *xy, *xz, *yy, *yz, *zz;
  double *smallest, *middle, *largest;           ///< Eigenvalues.
  double *smallest_x, *smallest_y, *smallest_z;  ///< Unit eigenvector of the smallest.
  double *largest_x, *largest_y, *largest_z;     ///< Unit eigenvector of the largest.
};

/// The hot loops at one SIMD level; search_kernels.inc has their code, neighbor_search.h their
/// meaning. A query that is not finite has no neighbours. All limits are squared distances and
/// inclusive.
struct SearchKernels {
  /// R p + t in double, rounded to float once; `rotation` is row by row.
  void (*move)(const double rotation[9], const double translation[3], const PointsView& points,
               float* x, float* y, float* z);
  void (*nearest)(const KdTreeView& tree, const PointsView& queries, float limit,
                  std::int32_t* index, float* squared_distance);
  /// k results per query, nearest first; index -1 where there are fewer. `scratch` has
  /// ScratchFloats(k) floats.
  void (*k_nearest)(const KdTreeView& tree, const PointsView& queries, int k, float limit,
                    float* scratch, std::int32_t* index, float* squared_distance);
  /// Moments of the k nearest (k > 0) or of all within the limit (k = 0). `candidates` has room for
  /// all points of the tree.
  void (*moments)(const KdTreeView& tree, const PointsView& queries, int k, float limit,
                  float* scratch, std::int32_t* candidates, const MomentsView& moments);
  /// Lists the places in the tree of all points within the limit of the first query; returns how
  /// many. `points` has room for all of the tree's.
  std::int32_t (*within)(const KdTreeView& tree, const PointsView& query, float limit,
                         std::int32_t* points);
  void (*eigen)(std::size_t size, const EigenView& eigen);
};

constexpr std::size_t kWidestVector = 16;
constexpr std::size_t ScratchFloats(int k) {
  return 2 * kWidestVector * static_cast<std::size_t>(k);
}

const SearchKernels& SearchKernelsAt(SimdLevel level);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_NEIGHBORS_SEARCH_KERNELS_H_
