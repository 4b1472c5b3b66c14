// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/cloud/rings.h"
#include "icpscape/common/error.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

// One ring at 10 m, smooth but for a spike of `height_m` at every 100th point.
PointCloud SpikyRing(int points, double height_m) {
  PointCloud cloud;
  for (int k = 0; k < points; ++k) {
    const double azimuth = 2 * M_PI * k / points;
    const double range = k % 100 == 50 ? 10 + height_m : 10;
    cloud.x.push_back(static_cast<float>(range * std::cos(azimuth)));
    cloud.y.push_back(static_cast<float>(range * std::sin(azimuth)));
    cloud.z.push_back(-1);
    cloud.ring.push_back(0);
  }
  return cloud;
}

TEST(Features, SplitAtTheThreshold) {
  // A spike of h is 10 h away from its ten neighbours in sum: s = h / (10 + h). A neighbour of a
  // spike has s = h / 100, and the ring's own curve gives less than 1e-4.
  const PointCloud cloud = SpikyRing(2000, 2);
  const Features features = ExtractFeatures(cloud, {}, 1);
  EXPECT_EQ(features.num_edge, 20U);
  EXPECT_EQ(features.num_planar, 2000U - 20U - 10U);  // Five points at each end have no class.
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(features.edge[i] != 0, i % 100 == 50) << i;
    EXPECT_EQ(features.planar[i] != 0, i >= 5 && i < 1995 && i % 100 != 50) << i;
  }
  FeatureOptions options;
  options.edge_from = 0.2;  // s = 1/6: between the two thresholds lies no class.
  EXPECT_EQ(ExtractFeatures(cloud, options, 1).num_edge, 0U);
  options.planar_below = 0.2;
  EXPECT_EQ(ExtractFeatures(cloud, options, 1).num_planar, 1990U);
}

// The classes of the points that a filter keeps are those that they had in the whole scan.
TEST(Features, FollowTheirPoints) {
  const PointCloud cloud = SpikyRing(2000, 2);
  const Features features = ExtractFeatures(cloud, {}, 1);
  std::vector<char> keep(cloud.size(), 0);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i % 7 < 3) {
      keep[i] = 1;
      kept.push_back(i);
    }
  }
  const Features selected = features.Select(keep);
  ASSERT_EQ(selected.edge.size(), kept.size());
  ASSERT_EQ(selected.planar.size(), kept.size());
  std::size_t edges = 0, planar = 0;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    EXPECT_EQ(selected.edge[k], features.edge[kept[k]]);
    EXPECT_EQ(selected.planar[k], features.planar[kept[k]]);
    edges += selected.edge[k] != 0 ? 1U : 0U;
    planar += selected.planar[k] != 0 ? 1U : 0U;
  }
  EXPECT_GT(edges, 5U);
  EXPECT_EQ(selected.num_edge, edges);
  EXPECT_EQ(selected.num_planar, planar);
  EXPECT_TRUE(Features().Select(keep).edge.empty());  // Where none were needed.
}

TEST(Features, TakeTheThresholdsOfTheirConvention) {
  for (const auto formula : {SmoothnessFormula::kPrinted, SmoothnessFormula::kALoam}) {
    const FeatureOptions options = ConventionalFeatureOptions(formula);
    EXPECT_EQ(options.smoothness.formula, formula);
    EXPECT_EQ(options.planar_below, 0.1);
    EXPECT_EQ(options.edge_from, 0.1);
  }
  EXPECT_EQ(ConventionalFeatureOptions(SmoothnessFormula::kLioSam).edge_from, 1.0);
}

TEST(Features, AreCappedPerRegionWithTheLargestFirst) {
  // Four regions of 500 points, five spikes each; the spike of point 750 is the tallest of its
  // region, that of 850 the second.
  PointCloud cloud = SpikyRing(2000, 2);
  for (const auto& [index, factor] : {std::pair{750, 1.5f}, std::pair{850, 1.25f}}) {
    const auto i = static_cast<std::size_t>(index);
    cloud.x[i] *= factor, cloud.y[i] *= factor, cloud.z[i] *= factor;
  }
  FeatureOptions options;
  options.caps = kLoamCaps;
  const Features features = ExtractFeatures(cloud, options, 1);
  EXPECT_EQ(features.num_edge, 4U * 2U);
  EXPECT_EQ(features.num_planar, 4U * 4U);
  EXPECT_TRUE(features.edge[750] != 0 && features.edge[850] != 0);
  // Equal spikes: float rounding decides which of them, but two from each region.
  for (std::size_t region = 0; region < 4; ++region) {
    int edges = 0;
    for (std::size_t i = 500 * region; i < 500 * (region + 1); ++i) {
      edges += features.edge[i];
    }
    EXPECT_EQ(edges, 2);
  }
}

// A-LOAM: six regions, with two edges, or up to twenty: here all that are there.
TEST(Features, AreCappedAsALoamCapsThem) {
  const PointCloud cloud = SpikyRing(2000, 2);
  FeatureOptions options;
  options.caps = kALoamSharpCaps;
  EXPECT_EQ(ExtractFeatures(cloud, options, 1).num_edge, 6U * 2U);
  EXPECT_EQ(ExtractFeatures(cloud, options, 1).num_planar, 6U * 4U);
  options.caps = kALoamLessSharpCaps;
  EXPECT_EQ(ExtractFeatures(cloud, options, 1).num_edge, 20U);
  EXPECT_EQ(ExtractFeatures(cloud, options, 1).num_planar, 6U * 4U);
  // Of a ring of nothing but spikes and flanks there are more than twenty to a region.
  PointCloud jagged = SpikyRing(2000, 0);
  for (std::size_t i = 0; i < jagged.size(); i += 12) {
    jagged.x[i] *= 1.3F, jagged.y[i] *= 1.3F;
  }
  EXPECT_EQ(ExtractFeatures(jagged, options, 1).num_edge, 6U * 20U);
}

TEST(Features, OfCappedRingsKeepTheirDistance) {
  const PointCloud cloud = SpikyRing(2000, 2);
  FeatureOptions options;
  options.caps = {1, 100, 1000};
  const Features features = ExtractFeatures(cloud, options, 1);
  EXPECT_EQ(features.num_edge, 20U);
  std::size_t previous = 0;
  bool first = true;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (features.edge[i] != 0 || features.planar[i] != 0) {
      EXPECT_TRUE(first || i - previous > 5) << i;
      previous = i;
      first = false;
    }
  }
}

TEST(Features, RefuseWhatCannotBe) {
  PointCloud cloud = SpikyRing(200, 1);
  FeatureOptions options;
  options.planar_below = 0.2;
  EXPECT_THROW(ExtractFeatures(cloud, options, 1), UsageError);
  options = {};
  options.caps.regions_per_ring = -1;
  EXPECT_THROW(ExtractFeatures(cloud, options, 1), UsageError);
  options = {};
  options.smoothness.neighborhood = SmoothnessNeighborhood::kKNearest;
  cloud.ring.clear();
  EXPECT_EQ(ExtractFeatures(cloud, options, 1).edge.size(), 200U);
  options.caps = kLoamCaps;
  EXPECT_THROW(ExtractFeatures(cloud, options, 1), InputError);
}

TEST(Features, OfARealScanAreTheKnownShares) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  PointCloud cloud = KittiScan("00", 15);
  RecoverRings(&cloud);
  FeatureOptions options;
  const Features ring = ExtractFeatures(cloud, options, 2);
  // A second implementation, outside this project, counts the same 9286 of 121023 points, 7.7 %.
  EXPECT_EQ(ring.num_edge, 9286U);
  EXPECT_EQ(ring.num_edge + ring.num_planar + 64 * 10, cloud.size());
  // Other neighbourhoods find hardly any edge.
  options.smoothness.neighborhood = SmoothnessNeighborhood::kKNearest;
  EXPECT_EQ(ExtractFeatures(cloud, options, 2).num_edge, 24U);
  options.smoothness.neighborhood = SmoothnessNeighborhood::kRadius;
  EXPECT_EQ(ExtractFeatures(cloud, options, 2).num_edge, 12U);
}

}  // namespace
}  // namespace icpscape
