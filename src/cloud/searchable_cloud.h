// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
#define ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "src/cloud/point_cloud.h"
#include "src/neighbors/neighbor_search.h"

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
  /// The points and their normals in the order of search().Order(), padded: what is near in space
  /// is near in the memory. A point without a normal has (0, 0, 0).
  PointsView points() const { return search().OrderedPoints(); }
  PointsView normals() const {
    const Index& of = index();
    return {of.nx.data(), of.ny.data(), of.nz.data(), of.search.OrderedPoints().size};
  }
  /// The place of a point in that order; -1 for a point that is not finite.
  std::int32_t Place(std::size_t point) const { return index().place[point]; }

 private:
  // What the search adds to the cloud.
  struct Index {
    Index(const PointCloud& cloud, NeighborSearch built);

    NeighborSearch search;
    std::vector<float> nx, ny, nz;    // In the order of the search.
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
