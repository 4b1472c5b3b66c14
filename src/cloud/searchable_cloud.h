// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
#define ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_

#include <memory>
#include <vector>

#include "src/cloud/point_cloud.h"
#include "src/neighbors/neighbor_search.h"

namespace icpscape {

/// A point and its normal side by side.
struct alignas(32) PackedPoint {
  float point[3];
  float normal[3];  ///< (0, 0, 0) where there is none.

  Vec3 Point() const { return {point[0], point[1], point[2]}; }
  Vec3 Normal() const { return {normal[0], normal[1], normal[2]}; }
  bool NormalIsValid() const { return normal[0] != 0 || normal[1] != 0 || normal[2] != 0; }
};

/// A cloud as matching needs it: with the search over its points. Building one costs about as much
/// as matching a scan twice, so whoever needs it in several places makes one and hands out copies,
/// which share it.
class SearchableCloud {
 public:
  /// Not explicit: a cloud is searchable. It must outlive this object and its copies, unchanged.
  SearchableCloud(const PointCloud& cloud);  // NOLINT(google-explicit-constructor)

  const PointCloud& cloud() const { return *cloud_; }
  const NeighborSearch& search() const { return search_; }
  /// The points in the order of search().Order(): what is near in space is near in the memory.
  const std::vector<PackedPoint>& packed() const { return shared_->packed; }
  /// Where in that order the point of an index is; -1 for one that is not finite.
  std::int32_t Place(std::size_t index) const { return shared_->place[index]; }

 private:
  const PointCloud* cloud_;
  NeighborSearch search_;
  struct Shared {
    std::vector<PackedPoint> packed;
    std::vector<std::int32_t> place;
  };
  std::shared_ptr<const Shared> shared_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
