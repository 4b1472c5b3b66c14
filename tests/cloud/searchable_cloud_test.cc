// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/searchable_cloud.h"

#include <gtest/gtest.h>

#include <optional>

#include "icpscape/cloud/normals.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

TEST(SearchableCloud, IsTheSameWithASearchThatIsThereAlready) {
  const PointCloud plain = testing_support::Room(5000, 1);
  PointCloud own = plain, given = plain;
  const NeighborSearch search(plain.View(), 2);
  NeighborhoodOptions radius;
  radius.radius_m = 0.6;
  for (const NeighborhoodOptions& options : {NeighborhoodOptions(), radius}) {
    EXPECT_EQ(EstimateNormals(search, options, 2, &given), EstimateNormals(options, 1, &own));
    EXPECT_EQ(given.nx, own.nx);
    EXPECT_EQ(given.ny, own.ny);
    EXPECT_EQ(given.nz, own.nz);
  }
  const SearchableCloud a(own), b(given, search);
  EXPECT_EQ(b.cloud().x, given.x);
  EXPECT_EQ(a.search().Order(), b.search().Order());
  ASSERT_EQ(a.points().size, b.points().size);
  for (std::size_t i = 0; i < own.size(); ++i) {
    ASSERT_EQ(a.Place(i), b.Place(i));
    const auto place = static_cast<std::size_t>(b.Place(i));
    EXPECT_EQ(b.points().x[place], plain.x[i]);
    EXPECT_EQ(b.points().z[place], plain.z[i]);
    EXPECT_EQ(b.normals().x[place], own.nx[i]);
    EXPECT_EQ(b.normals().y[place], own.ny[i]);
    EXPECT_EQ(b.normals().z[place], own.nz[i]);
  }
}

TEST(SearchableCloud, MayBeEmpty) {
  const PointCloud none;
  const SearchableCloud cloud(none);
  EXPECT_EQ(cloud.points().size, 0U);
  EXPECT_TRUE(cloud.search().Order().empty());
}

// Copies share the cloud and its search, and outlive what they were made of.
TEST(SearchableCloud, OwnsWhatItIsMadeOf) {
  const long before = SearchesBuilt();
  std::optional<SearchableCloud> first(testing_support::Room(500, 3));
  const SearchableCloud copy = *first;
  EXPECT_EQ(SearchesBuilt(), before);  // No search was needed yet.
  EXPECT_EQ(&copy.search(), &first->search());
  EXPECT_EQ(&copy.cloud(), &first->cloud());
  first.reset();
  EXPECT_EQ(copy.cloud().size(), 500U);
  EXPECT_EQ(copy.search().Nearest(copy.cloud().Point(7).cast<float>(), 1).index, 7);
  EXPECT_EQ(SearchesBuilt(), before + 1);
}

}  // namespace
}  // namespace icpscape
