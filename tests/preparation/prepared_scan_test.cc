// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/preparation/prepared_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "icpscape/cloud/rings.h"
#include "icpscape/common/error.h"
#include "icpscape/filtering/voxel_filter.h"
#include "icpscape/minimizer/ground_truth_check.h"
#include "icpscape/objective/objective_set.h"
#include "icpscape/preparation/elevation.h"
#include "tests/support/drives.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::MessageOf;
using testing_support::TownDrive;

constexpr unsigned kNormals = kSourceNormal | kTargetNormal;

PointCloud Scan() { return TownDrive().scans[0]; }

TEST(PreparedScan, DoesWhatIsNeededAndNoMore) {
  const auto points = Prepare(Scan(), 0, {}, 1);
  EXPECT_EQ(points.cloud().x, Scan().x);
  EXPECT_FALSE(points.cloud().has_normals());
  EXPECT_FALSE(points.clouds().edges || points.clouds().planar);
  EXPECT_FALSE(points.features());

  for (const unsigned needs : {kSourceNormal, kTargetNormal}) {
    EXPECT_TRUE(Prepare(Scan(), needs, {}, 1).cloud().has_normals());
  }

  for (const unsigned needs : {kTargetLine, kTargetPatch}) {
    const auto features = Prepare(Scan(), needs, {}, 1);
    EXPECT_FALSE(features.cloud().has_normals());
    EXPECT_EQ(features.features()->edge.size(), Scan().size());
    ASSERT_TRUE(features.clouds().edges && features.clouds().planar);
    EXPECT_EQ(features.clouds().edges->cloud().size(), features.features()->num_edge);
    EXPECT_EQ(features.clouds().planar->cloud().size(), features.features()->num_planar);
  }
}

TEST(PreparedScan, EqualsItsSteps) {
  PointCloud cloud = Scan();
  EstimateNormals({}, 1, &cloud);
  const Features features = ExtractFeatures(cloud, {}, 1);
  const auto prepared = Prepare(Scan(), kNormals | kTargetLine | kTargetPatch, {}, 2);
  EXPECT_EQ(prepared.cloud().nx, cloud.nx);
  EXPECT_EQ(prepared.cloud().nz, cloud.nz);
  EXPECT_EQ(prepared.features()->edge, features.edge);
  EXPECT_EQ(prepared.features()->planar, features.planar);
  EXPECT_EQ(prepared.clouds().edges->cloud().x, cloud.Select(features.edge).x);
  EXPECT_EQ(prepared.clouds().edges->cloud().nx, cloud.Select(features.edge).nx);
  EXPECT_EQ(prepared.clouds().planar->cloud().y, cloud.Select(features.planar).y);
  // The searchable clouds have the normals too, which are there after the search.
  const SearchableCloud& points = *prepared.clouds().points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(points.normals().x[static_cast<std::size_t>(points.Place(i))], cloud.nx[i]);
  }
}

// The order is that of the options: elevation, voxels, normals.
TEST(PreparedScan, ThinsAfterTheElevationAndBeforeTheNormals) {
  PreparationOptions options;
  options.elevation_correction_deg = 0.3;
  options.voxel_m = 0.4;
  options.normals.num_neighbors = 7;
  PointCloud cloud = Scan();
  CorrectElevation(0.3, &cloud);
  cloud = VoxelFilter(cloud, 0.4);
  EstimateNormals(options.normals, 1, &cloud);
  const auto prepared = Prepare(Scan(), kNormals, options, 2);
  EXPECT_LT(cloud.size(), Scan().size() / 2);
  EXPECT_EQ(prepared.cloud().x, cloud.x);
  EXPECT_EQ(prepared.cloud().z, cloud.z);
  EXPECT_EQ(prepared.cloud().ny, cloud.ny);
}

TEST(PreparedScan, RecoversRingsWhereTheyAreNeeded) {
  PointCloud cloud = Scan();
  cloud.ring.clear();
  EXPECT_TRUE(Prepare(cloud, kNormals, {}, 1).cloud().ring.empty());
  PointCloud recovered = cloud;
  RecoverRings(&recovered);
  const auto prepared = Prepare(cloud, kTargetLine, {}, 1);
  EXPECT_EQ(prepared.cloud().ring, recovered.ring);
  EXPECT_EQ(prepared.features()->edge, ExtractFeatures(recovered, {}, 1).edge);
  // Points in no order have no rings, which matters only where the neighbourhood is of a ring.
  const PointCloud room = testing_support::Room(3000, 1);
  EXPECT_THAT(MessageOf([&] { Prepare(room, kTargetLine, {}, 1); }),
              HasSubstr("rings by their azimuth"));
  PreparationOptions nearest;
  nearest.features.smoothness.neighborhood = SmoothnessNeighborhood::kKNearest;
  EXPECT_EQ(Prepare(room, kTargetLine, nearest, 1).features()->edge.size(), room.size());
}

// A scan of a sensor that is covered: too few points for normals.
TEST(PreparedScan, TakesScansOfAlmostNothing) {
  for (const std::size_t size : {0U, 1U, 2U, 3U}) {
    PointCloud few;
    for (std::size_t i = 0; i < size; ++i) {
      testing_support::AddPoint(Vec3(5, static_cast<double>(i), 0), &few);
    }
    const auto prepared = Prepare(few, kNormals, {}, 2);
    EXPECT_EQ(prepared.cloud().size(), size);
    EXPECT_TRUE(prepared.cloud().has_normals());
    EXPECT_EQ(prepared.clouds().points->points().size, size);
  }
}

TEST(PreparedScan, DoesNotDependOnThreads) {
  const auto one = Prepare(Scan(), kNormals | kTargetLine, {}, 1);
  for (const int threads : {2, 4}) {
    const auto many = Prepare(Scan(), kNormals | kTargetLine, {}, threads);
    EXPECT_EQ(many.cloud().nx, one.cloud().nx);
    EXPECT_EQ(many.cloud().nz, one.cloud().nz);
    EXPECT_EQ(many.features()->edge, one.features()->edge);
  }
}

// What a filter leaves has the normals and features that the whole scan had.
TEST(PreparedScan, SelectKeepsNormalsAndFeaturesWithTheirPoints) {
  const PreparedScan whole = Prepare(Scan(), kNormals | kTargetLine, {}, 2);
  std::vector<char> keep(Scan().size());
  for (std::size_t i = 0; i < keep.size(); ++i) {
    keep[i] = i % 3 == 1 ? 1 : 0;
  }
  const PreparedScan part = whole.Select(keep, 2);
  ASSERT_GT(part.features()->num_edge, 10U);
  std::size_t at = 0, edges = 0;
  for (std::size_t i = 1; i < keep.size(); i += 3, ++at) {
    EXPECT_EQ(part.cloud().x[at], Scan().x[i]);
    EXPECT_EQ(part.cloud().nz[at], whole.cloud().nz[i]);
    EXPECT_EQ(part.features()->edge[at], whole.features()->edge[i]);
    if (part.features()->edge[at] != 0) {
      EXPECT_EQ(part.clouds().edges->cloud().y[edges++], Scan().y[i]);
    }
  }
  EXPECT_EQ(part.cloud().size(), at);
  EXPECT_EQ(part.clouds().edges->cloud().size(), edges);
}

// Normals, the check of the ground truth and matching search one tree per scan.
TEST(PreparedPair, BuildsOneTreePerScan) {
  const long before = SearchesBuilt();
  const PreparedPair pair =
      PreparePair(Scan(), TownDrive().scans[1], kSourceNormal | kTargetNormal, {}, 2);
  const ObjectiveSet set(pair, {"point_to_plane", "symmetric", "point_to_point"}, {});
  CheckGroundTruth(*pair.source.clouds().points, *pair.target.clouds().points, SE3d(), 2);
  for (const Objective& objective : set.objectives()) {
    objective.Evaluate(SE3d(), 2);
  }
  EXPECT_EQ(SearchesBuilt() - before, 2);
  EXPECT_TRUE(pair.source.cloud().has_normals() && pair.target.cloud().has_normals());
  // Without normals in the source its tree is built for the matching.
  const long between = SearchesBuilt();
  const PreparedPair plane = PreparePair(Scan(), TownDrive().scans[1], kTargetNormal, {}, 2);
  EXPECT_EQ(SearchesBuilt() - between, 1);
  EXPECT_FALSE(plane.source.cloud().has_normals());
  const ObjectiveSet planes(plane, {"point_to_plane"}, {});
  EXPECT_EQ(SearchesBuilt() - between, 2);
}

}  // namespace
}  // namespace icpscape
