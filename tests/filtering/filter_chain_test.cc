// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/filter_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <tuple>

#include "icpscape/common/error.h"
#include "icpscape/filtering/ego_blind_spot.h"
#include "icpscape/filtering/octree_correspondence_filter.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::ElementsAre;
using testing_support::MessageOf;

const SE3d kEstimate = SE3d::Exp((Vec6() << 0, 0, 0.1, 1.5, 0.2, 0).finished());

// A room whose points carry their index as label.
PointCloud NumberedRoom(unsigned seed) {
  PointCloud cloud = testing_support::Room(6000, seed);
  cloud.label.resize(cloud.size());
  std::iota(cloud.label.begin(), cloud.label.end(), 0);
  return cloud;
}

// The indices that a mask keeps.
std::vector<std::int32_t> Kept(const std::vector<char>& keep) {
  std::vector<std::int32_t> indices;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0) {
      indices.push_back(static_cast<std::int32_t>(i));
    }
  }
  return indices;
}

// Every subset of the filters: what the chain keeps is what the filters keep one after the other,
// and its masks are about the points that came in.
TEST(FilterChain, IsItsFiltersOneAfterTheOther) {
  const PointCloud source = NumberedRoom(1), target = NumberedRoom(2);
  std::size_t fewest = source.size();
  for (int subset = 0; subset < 8; ++subset) {
    FilterOptions options;
    options.artificial_blind_spot_m = (subset & 1) != 0 ? 5.5 : 0;
    options.ego_blind_spot_m = (subset & 2) != 0 ? 6 : 0;
    options.octree_voxel_m = (subset & 4) != 0 ? 0.4 : 0;
    EXPECT_EQ(options.Any(), subset != 0);
    EXPECT_EQ(options.NeedEstimate(), subset >= 2);
    PointCloud expected_source = source, expected_target = target;
    std::vector<std::string> names;
    const auto take = [&](const std::string& name, const KeptPoints& kept) {
      names.push_back(name);
      const PointCloud before = expected_source;
      expected_source = expected_source.Select(kept.source);
      expected_target = expected_target.Select(kept.target);
      EXPECT_LT(expected_source.size(), before.size()) << name;
    };
    if (options.artificial_blind_spot_m > 0) {
      take("artificial_blind_spot", ArtificialBlindSpots(expected_source, expected_target, 5.5));
    }
    if (options.ego_blind_spot_m > 0) {
      take("ego_filter", EgoBlindSpotFilter(expected_source, expected_target, kEstimate, 6));
    }
    if (options.octree_voxel_m > 0) {
      take("octree_filter",
           OctreeCorrespondenceFilter(expected_source, expected_target, kEstimate, {0.4}));
    }
    std::vector<std::string> reported;
    std::size_t came = source.size();
    const KeptPoints kept = ApplyFilters(source, target, kEstimate, options,
                                         [&](const std::string& name, const KeptPoints& of_this) {
                                           reported.push_back(name);
                                           EXPECT_EQ(of_this.source.size(), came)
                                               << name;  // What the filter before left.
                                           came = Kept(of_this.source).size();
                                         });
    EXPECT_EQ(reported, names);
    EXPECT_EQ(Kept(kept.source), expected_source.label) << subset;
    EXPECT_EQ(Kept(kept.target), expected_target.label) << subset;
    EXPECT_EQ(kept.source.size(), source.size());
    EXPECT_EQ(kept.target.size(), target.size());
    fewest = std::min(fewest, expected_source.size());
  }
  EXPECT_GT(fewest, 100U);  // No comparison was of empty masks.
}

TEST(FilterChain, NamesTheFilterThatLeavesNothing) {
  const PointCloud room = NumberedRoom(1);
  const auto message = [&](const FilterOptions& options, const SE3d& T) {
    return MessageOf<ComputationError>([&] { ApplyFilters(room, room, T, options); });
  };
  EXPECT_EQ(message({100, 0, 0}, SE3d()),
            "artificial_blind_spot: no point is left; expected at least one.");
  EXPECT_EQ(message({5, 100, 0}, SE3d()), "ego_filter: no point is left; expected at least one.");
  const SE3d far(Mat3::Identity(), Vec3(500, 0, 0));
  EXPECT_EQ(message({5, 0, 0.1}, far), "octree_filter: no point is left; expected at least one.");
}

}  // namespace
}  // namespace icpscape
