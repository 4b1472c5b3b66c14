// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/searchable_cloud.h"

#include <type_traits>
#include <utility>

namespace icpscape {

SearchableCloud::Index::Index(const PointCloud& cloud, NeighborSearch built)
    : search(std::move(built)) {
  const std::vector<std::int32_t>& order = search.Order();
  place.assign(cloud.size(), -1);
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  }
  PointCloud::ForEachKind([&](auto kind) {
    if constexpr (!std::is_same_v<decltype(kind), kind::Point>) {
      const auto arrays = PointCloud::ArraysOf(kind);
      for (const PointCloud::Array array : arrays) {
        (ordered.*array).resize(order.size() + kPadding);
      }
      for (std::size_t k = 0; k < order.size() && cloud.Carries(kind); ++k) {
        const auto i = static_cast<std::size_t>(order[k]);
        if (cloud.IsValid(kind, i)) {
          for (const PointCloud::Array array : arrays) {
            (ordered.*array)[k] = (cloud.*array)[i];
          }
        }
      }
    }
  });
}

SearchableCloud::SearchableCloud(PointCloud cloud, int threads)
    : shared_(std::make_shared<const Shared>(std::move(cloud), threads)) {}

SearchableCloud::SearchableCloud(PointCloud cloud, NeighborSearch search)
    : SearchableCloud(std::move(cloud)) {
  Build(std::move(search));
}

void SearchableCloud::Build(NeighborSearch search) const {
  shared_->index = std::make_unique<const Index>(shared_->cloud, std::move(search));
  shared_->built.store(shared_->index.get(), std::memory_order_release);
}

const SearchableCloud::Index& SearchableCloud::Build() const {
  std::call_once(shared_->once, [this] {
    if (shared_->built.load(std::memory_order_acquire) == nullptr) {
      Build(NeighborSearch(shared_->cloud.View(), shared_->threads));
    }
  });
  return *shared_->index;
}

}  // namespace icpscape
