// SPDX-License-Identifier: BSD-3-Clause
#include "src/cloud/searchable_cloud.h"

#include <type_traits>
#include <utility>

namespace icpscape {

SearchableCloud::SearchableCloud(const PointCloud& cloud, int threads)
    : SearchableCloud(cloud, NeighborSearch(cloud.View(), threads)) {}

SearchableCloud::SearchableCloud(const PointCloud& cloud, NeighborSearch search)
    : cloud_(&cloud), search_(std::move(search)) {
  const std::vector<std::int32_t>& order = search_.Order();
  auto shared = std::make_shared<Shared>();
  shared->place.assign(cloud.size(), -1);
  for (std::size_t place = 0; place < order.size(); ++place) {
    shared->place[static_cast<std::size_t>(order[place])] = static_cast<std::int32_t>(place);
  }
  PointCloud::ForEachKind([&](auto kind) {
    if constexpr (!std::is_same_v<decltype(kind), kind::Point>) {
      const auto arrays = PointCloud::ArraysOf(kind);
      for (const PointCloud::Array array : arrays) {
        (shared->ordered.*array).resize(order.size() + kPadding);
      }
      for (std::size_t place = 0; place < order.size() && cloud.Carries(kind); ++place) {
        const auto i = static_cast<std::size_t>(order[place]);
        if (cloud.IsValid(kind, i)) {
          for (const PointCloud::Array array : arrays) {
            (shared->ordered.*array)[place] = (cloud.*array)[i];
          }
        }
      }
    }
  });
  shared_ = std::move(shared);
}

}  // namespace icpscape
