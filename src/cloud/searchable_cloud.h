// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
#define ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/neighbors/neighbor_search.h"

namespace icpscape {

/// A cloud with the search over its points, as matching needs it. Copies share both, so that a
/// search is built once however many matchers use it. It is built at its first use: whoever only
/// reads the points does not pay for it.
class SearchableCloud {
 public:
  /// Not explicit: a cloud is searchable. Takes the cloud; more threads only shorten the building.
  SearchableCloud(PointCloud cloud, int threads = 1);  // NOLINT(google-explicit-constructor)

  /// With a search over the cloud's points that was built before.
  SearchableCloud(PointCloud cloud, NeighborSearch search);

  const PointCloud& cloud() const { return shared_->cloud; }
  /// With which the search is built.
  int threads() const { return shared_->threads; }
  const NeighborSearch& search() const { return index().search; }
  PointsView points() const { return search().OrderedPoints(); }
  /// The numbers of what the points carry of a kind, in the order of search().Order(), padded: what
  /// is near in space is near in the memory. They are 0 for a point that has none.
  std::array<const float*, 3> Numbers(kind::Point) const {
    const PointsView view = points();
    return {view.x, view.y, view.z};
  }
  template <class Kind>
  std::array<const float*, Kind::kSize> Numbers(Kind kind) const {
    const PointCloud& ordered = index().ordered;
    std::array<const float*, Kind::kSize> numbers;
    for (std::size_t k = 0; k < Kind::kSize; ++k) {
      numbers[k] = (ordered.*PointCloud::ArraysOf(kind)[k]).data();
    }
    return numbers;
  }
  PointsView normals() const {
    const auto numbers = Numbers(kind::Direction());
    return {numbers[0], numbers[1], numbers[2], points().size};
  }
  /// The place of a point in that order; -1 for a point that is not finite.
  std::int32_t Place(std::size_t point) const { return index().place[point]; }

 private:
  // What the search adds to the cloud.
  struct Index {
    Index(const PointCloud& cloud, NeighborSearch built);

    NeighborSearch search;
    PointCloud ordered;  // In the order of the search; without the points, which it has.
    std::vector<std::int32_t> place;  // Of each point in that order.
  };
  struct Shared {
    Shared(PointCloud c, int t) : cloud(std::move(c)), threads(t) {}

    const PointCloud cloud;
    const int threads;
    mutable std::once_flag once;
    mutable std::unique_ptr<const Index> index;
    mutable std::atomic<const Index*> built = nullptr;
  };

  // Inline and without a lock once it is built: asked for every pair.
  const Index& index() const {
    const Index* built = shared_->built.load(std::memory_order_acquire);
    return built != nullptr ? *built : Build();
  }
  const Index& Build() const;
  void Build(NeighborSearch search) const;

  std::shared_ptr<const Shared> shared_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
