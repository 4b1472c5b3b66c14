// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_NEIGHBORS_KD_TREE_H_
#define ICPSCAPE_SRC_NEIGHBORS_KD_TREE_H_

#include <vector>

#include "icpscape/neighbors/kd_tree_view.h"
#include "icpscape/neighbors/points_view.h"

namespace icpscape {

/// A kd-tree over fixed points: split at the median of the longest side, boxes as tight as the
/// points allow, points copied leaf by leaf. Points with a NaN or an infinity are left out.
class KdTree {
 public:
  /// The tree does not depend on `threads`.
  KdTree(const PointsView& points, int threads);

  /// Valid while the tree lives.
  KdTreeView View() const;

  /// The points' indices, leaf by leaf: what is near in space is near in this list.
  const std::vector<std::int32_t>& index() const { return index_; }

 private:
  class Builder;

  // Leaf k holds the points from place k * kLeafPoints on, and node k is the one that splits there:
  // every subtree knows its place before its neighbours are built.
  std::vector<KdTreeNode> nodes_;
  std::int32_t root_ = 0;
  std::vector<KdTreeLeaf> leaves_;
  std::vector<float> x_, y_, z_;
  std::vector<std::int32_t> index_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_NEIGHBORS_KD_TREE_H_
