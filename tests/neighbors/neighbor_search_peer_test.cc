// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nanoflann.hpp>
#include <vector>

#include "icpscape/io/kitti.h"
#include "icpscape/neighbors/neighbor_search.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"
#include "tests/support/simd_levels.h"

namespace icpscape {
namespace {

// A peer's tree on whole scans. It does not promise who wins a tie, so distances are compared.
struct NanoflannCloud {
  const PointCloud& cloud;
  std::size_t kdtree_get_point_count() const { return cloud.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return axis == 0 ? cloud.x[i] : axis == 1 ? cloud.y[i] : cloud.z[i];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

void ExpectEqualsNanoflann(const PointCloud& target, const PointCloud& source) {
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, NanoflannCloud>,
                                          NanoflannCloud, 3, int>;
  const NanoflannCloud adaptor{target};
  Tree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const NeighborSearch search(target.View());
  std::vector<Neighbor> ours;
  search.KNearest(source.View(), 5, &ours);
  for (std::size_t i = 0; i < source.size(); ++i) {
    const float query[] = {source.x[i], source.y[i], source.z[i]};
    int index[5];
    float squared_distance[5];
    nanoflann::KNNResultSet<float, int> result(5);
    result.init(index, squared_distance);
    tree.findNeighbors(result, query, nanoflann::SearchParams());
    for (std::size_t n = 0; n < 5; ++n) {
      ASSERT_EQ(ours[5 * i + n].squared_distance, squared_distance[n]) << i;
    }
  }
}

class NanoflannAt : public testing_support::EverySimdLevel {};
ICPSCAPE_INSTANTIATE_SIMD_LEVELS(NanoflannAt);

TEST_P(NanoflannAt, EqualsOursOnAWholeRealPair) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const KittiFiles sequence(KittiRoot(), "07");
  DroppedPoints dropped;
  ExpectEqualsNanoflann(ReadVelodyne(sequence.Scan(0), &dropped),
                        ReadVelodyne(sequence.Scan(4), &dropped));
}

TEST_P(NanoflannAt, EqualsOursOnAMovedRoom) {
  const SE3d motion = SE3d::Exp((Vec6() << 0.01, 0, 0.05, 0.3, 0.1, 0).finished());
  ExpectEqualsNanoflann(testing_support::Room(20000, 1, SE3d(), 0.01),
                        testing_support::Room(20000, 2, motion, 0.01));
}

}  // namespace
}  // namespace icpscape
