// SPDX-License-Identifier: BSD-3-Clause
#include "src/cloud/searchable_cloud.h"

namespace icpscape {

SearchableCloud::SearchableCloud(const PointCloud& cloud, int threads)
    : cloud_(&cloud), search_(cloud.View(), threads) {
  const std::vector<std::int32_t>& order = search_.Order();
  auto shared = std::make_shared<Shared>();
  shared->place.assign(cloud.size(), -1);
  for (std::size_t place = 0; place < order.size(); ++place) {
    shared->place[static_cast<std::size_t>(order[place])] = static_cast<std::int32_t>(place);
  }
  const auto in_order = [&](const std::vector<float>& from, std::vector<float>* to) {
    to->resize(order.size() + kPadding);
    for (std::size_t place = 0; place < order.size() && !from.empty(); ++place) {
      (*to)[place] = from[static_cast<std::size_t>(order[place])];
    }
  };
  in_order(cloud.nx, &shared->nx);
  in_order(cloud.ny, &shared->ny);
  in_order(cloud.nz, &shared->nz);
  shared_ = std::move(shared);
}

}  // namespace icpscape
