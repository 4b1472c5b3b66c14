// SPDX-License-Identifier: BSD-3-Clause
#include "src/cloud/searchable_cloud.h"

namespace icpscape {

SearchableCloud::SearchableCloud(const PointCloud& cloud) : cloud_(&cloud), search_(cloud.View()) {
  auto shared = std::make_shared<Shared>();
  shared->packed.reserve(cloud.size());
  shared->place.assign(cloud.size(), -1);
  for (const std::int32_t index : search_.Order()) {
    const auto i = static_cast<std::size_t>(index);
    shared->place[i] = static_cast<std::int32_t>(shared->packed.size());
    PackedPoint p = {{cloud.x[i], cloud.y[i], cloud.z[i]}, {0, 0, 0}};
    if (cloud.has_normals()) {
      p.normal[0] = cloud.nx[i];
      p.normal[1] = cloud.ny[i];
      p.normal[2] = cloud.nz[i];
    }
    shared->packed.push_back(p);
  }
  shared_ = std::move(shared);
}

}  // namespace icpscape
