// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_THINNED_H_
#define ICPSCAPE_SRC_ODOMETRY_THINNED_H_

#include <cstddef>
#include <vector>

#include "icpscape/cloud/searchable_cloud.h"

namespace icpscape {

/// At most that many points of the cloud: every second, third, ... one.
inline SearchableCloud Thinned(const SearchableCloud& cloud, std::size_t most) {
  const std::size_t size = cloud.cloud().size();
  if (size <= most) {
    return cloud;
  }
  const std::size_t every = (size + most - 1) / most;
  std::vector<char> keep(size);
  for (std::size_t i = 0; i < size; i += every) {
    keep[i] = 1;
  }
  return SearchableCloud(cloud.cloud().Select(keep), cloud.threads());
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_THINNED_H_
