// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_NEIGHBORS_KD_TREE_VIEW_H_
#define ICPSCAPE_SRC_NEIGHBORS_KD_TREE_VIEW_H_

#include <cstdint>

namespace icpscape {

/// Most points of a leaf, unless they are all at one place.
constexpr int kLeafPoints = 16;

/// An inner node knows its children's boxes: one cache line decides where to go.
struct alignas(64) KdTreeNode {
  float low[2][3];
  float high[2][3];
  std::int32_t child[2];  ///< A node's index, or the complement (~) of a leaf's.
};

/// A run of points, in order of their indices.
struct KdTreeLeaf {
  std::int32_t begin;
  std::int32_t count;  ///< At most kLeafPoints; more only where all of them are equal.
};

/// Plain pointers into a KdTree: what the kernels see.
struct KdTreeView {
  const KdTreeNode* nodes;
  std::int32_t root;
  const KdTreeLeaf* leaves;
  const float *x, *y, *z;     ///< Points, leaf by leaf.
  const std::int32_t* index;  ///< And which points of the cloud they are.
  std::int32_t num_points;
  std::int32_t num_leaves;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_NEIGHBORS_KD_TREE_VIEW_H_
