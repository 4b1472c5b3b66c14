// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
#define ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_

#include "src/cloud/point_cloud.h"
#include "src/neighbors/neighbor_search.h"

namespace icpscape {

/// A cloud and the search over its points. Building the search costs about as much as matching a
/// scan twice, so whoever needs it in several places makes one of these and hands out copies, which
/// share it.
class SearchableCloud {
 public:
  /// Not explicit: a cloud is searchable. It must outlive this object and its copies, unchanged.
  SearchableCloud(const PointCloud& cloud)  // NOLINT(google-explicit-constructor)
      : cloud_(&cloud), search_(cloud.View()) {}

  const PointCloud& cloud() const { return *cloud_; }
  const NeighborSearch& search() const { return search_; }

 private:
  const PointCloud* cloud_;
  NeighborSearch search_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_SEARCHABLE_CLOUD_H_
