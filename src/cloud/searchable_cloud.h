// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
#define ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_

#include <array>
#include <memory>
#include <vector>

#include "src/cloud/point_cloud.h"
#include "src/neighbors/neighbor_search.h"

namespace icpscape {

/// A cloud as matching needs it: with the search over its points. Building one costs about as much
/// as matching a scan twice, so whoever needs it in several places makes one and hands out copies,
/// which share it.
class SearchableCloud {
 public:
  /// Not explicit: a cloud is searchable; more threads only shorten the building. It must outlive
  /// this object and its copies, unchanged.
  SearchableCloud(const PointCloud& cloud, int threads = 1);  // NOLINT(google-explicit-constructor)

  /// With a search over the cloud's points that is there already.
  SearchableCloud(const PointCloud& cloud, NeighborSearch search);

  const PointCloud& cloud() const { return *cloud_; }
  const NeighborSearch& search() const { return search_; }
  PointsView points() const { return search_.OrderedPoints(); }
  /// The numbers of what the points carry of a kind, in the order of search().Order(), padded: what
  /// is near in space is near in the memory. They are 0 for a point that has none.
  std::array<const float*, 3> Numbers(kind::Point) const {
    return {points().x, points().y, points().z};
  }
  template <class Kind>
  std::array<const float*, Kind::kSize> Numbers(Kind kind) const {
    std::array<const float*, Kind::kSize> numbers;
    for (std::size_t k = 0; k < Kind::kSize; ++k) {
      numbers[k] = (shared_->ordered.*PointCloud::ArraysOf(kind)[k]).data();
    }
    return numbers;
  }
  PointsView normals() const {
    const auto numbers = Numbers(kind::Direction());
    return {numbers[0], numbers[1], numbers[2], points().size};
  }
  /// Where in that order the point of an index is; -1 for one that is not finite.
  std::int32_t Place(std::size_t index) const { return shared_->place[index]; }

 private:
  const PointCloud* cloud_;
  NeighborSearch search_;
  struct Shared {
    PointCloud ordered;  // Without the points, which the search has.
    std::vector<std::int32_t> place;
  };
  std::shared_ptr<const Shared> shared_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
