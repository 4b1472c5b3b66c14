// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/neighbors/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"

namespace icpscape {
namespace {

struct Point {
  float coordinate[3];
  std::int32_t index;
};

struct Box {
  float low[3];
  float high[3];
};

// Of no points: farther than any limit from everything.
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Box kEmptyBox = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

Box BoxOf(const Point* begin, const Point* end) {
  Box box = kEmptyBox;
  for (; begin != end; ++begin) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], begin->coordinate[axis]);
      box.high[axis] = std::max(box.high[axis], begin->coordinate[axis]);
    }
  }
  return box;
}

template <int kAxis>
void SplitAlong(Point* begin, Point* middle, Point* end) {
  std::nth_element(begin, middle, end, [](const Point& a, const Point& b) {
    return a.coordinate[kAxis] < b.coordinate[kAxis];
  });
}

}  // namespace

class KdTree::Builder {
 public:
  Builder(std::vector<Point> points, KdTree* tree) : points_(std::move(points)), tree_(tree) {}

  void Build(int threads) {
    const std::size_t size = points_.size();
    const std::size_t leaves = size / kLeafPoints + 2;  // With an empty one at the end.
    tree_->nodes_.resize(leaves);
    tree_->leaves_.resize(leaves);
    const Box box = BoxOf(points_.data(), points_.data() + size);
    std::int32_t root = AddSubtree(0, size, box, threads);
    if (root < 0) {
      // The root is a node even so: with one child, and one that nothing is near to.
      SetChild(0, 0, box, root);
      SetChild(0, 1, kEmptyBox, ~static_cast<std::int32_t>(leaves - 1));
      root = 0;
    }
    tree_->root_ = root;
    CopyPoints();
  }

 private:
  std::int32_t AddSubtree(std::size_t begin, std::size_t end, const Box& box, int threads) {
    const bool is_leaf = end - begin <= kLeafPoints || std::equal(box.low, box.low + 3, box.high);
    return is_leaf ? AddLeaf(begin, end) : AddNode(begin, end, box, threads);
  }

  std::int32_t AddLeaf(std::size_t begin, std::size_t end) {
    std::sort(points_.data() + begin, points_.data() + end,
              [](const Point& a, const Point& b) { return a.index < b.index; });
    const std::size_t leaf = begin / kLeafPoints;
    tree_->leaves_[leaf] = {static_cast<std::int32_t>(begin),
                            static_cast<std::int32_t>(end - begin)};
    return ~static_cast<std::int32_t>(leaf);
  }

  std::int32_t AddNode(std::size_t begin, std::size_t end, const Box& box, int threads) {
    int axis = 0;
    for (int other = 1; other < 3; ++other) {
      if (box.high[other] - box.low[other] > box.high[axis] - box.low[axis]) {
        axis = other;
      }
    }
    // Whole leaves to the left, so that only the last one of all is not full.
    const std::size_t half = (end - begin + 1) / 2;
    const std::size_t middle = begin + (half + kLeafPoints - 1) / kLeafPoints * kLeafPoints;
    Point* const points = points_.data();
    (axis == 0   ? SplitAlong<0>
     : axis == 1 ? SplitAlong<1>
                 : SplitAlong<2>)(points + begin, points + middle, points + end);
    const std::size_t node = middle / kLeafPoints;
    ParallelFor(2, std::min(threads, 2), [&](std::size_t side) {
      const std::size_t from = side == 0 ? begin : middle;
      const std::size_t to = side == 0 ? middle : end;
      const Box child_box = BoxOf(points + from, points + to);
      SetChild(node, side, child_box, AddSubtree(from, to, child_box, threads / 2));
    });
    return static_cast<std::int32_t>(node);
  }

  void SetChild(std::size_t node, std::size_t side, const Box& box, std::int32_t child) {
    KdTreeNode& parent = tree_->nodes_[node];
    std::copy(box.low, box.low + 3, parent.low[side]);
    std::copy(box.high, box.high + 3, parent.high[side]);
    parent.child[side] = child;
  }

  void CopyPoints() {
    const std::size_t size = points_.size();
    tree_->x_.resize(size + kPadding);
    tree_->y_.resize(size + kPadding);
    tree_->z_.resize(size + kPadding);
    tree_->index_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      tree_->x_[i] = points_[i].coordinate[0];
      tree_->y_[i] = points_[i].coordinate[1];
      tree_->z_[i] = points_[i].coordinate[2];
      tree_->index_[i] = points_[i].index;
    }
  }

  std::vector<Point> points_;
  KdTree* tree_;
};

KdTree::KdTree(const PointsView& points, int threads) {
  if (points.size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw InputError("a cloud of " + std::to_string(points.size) +
                     " points: expected at most 2147483647.");
  }
  std::vector<Point> finite;
  finite.reserve(points.size);
  for (std::size_t i = 0; i < points.size; ++i) {
    const Point point = {{points.x[i], points.y[i], points.z[i]}, static_cast<std::int32_t>(i)};
    if (std::isfinite(points.x[i]) && std::isfinite(points.y[i]) && std::isfinite(points.z[i])) {
      finite.push_back(point);
    }
  }
  Builder(std::move(finite), this).Build(threads);
}

KdTreeView KdTree::View() const {
  return {nodes_.data(),
          root_,
          leaves_.data(),
          x_.data(),
          y_.data(),
          z_.data(),
          index_.data(),
          static_cast<std::int32_t>(index_.size()),
          static_cast<std::int32_t>(leaves_.size())};
}

}  // namespace icpscape
