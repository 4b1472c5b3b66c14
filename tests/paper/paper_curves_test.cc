// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/paper_curves.h"

#include <gtest/gtest.h>

#include "icpscape/filtering/ego_blind_spot.h"
#include "icpscape/filtering/octree_correspondence_filter.h"
#include "icpscape/simulation/simulated_sequence.h"

namespace icpscape {
namespace {

ScanPair Simulated() {
  LidarOptions lidar;
  lidar.azimuth_step_deg = 1;
  return SimulatePair("highway", 1, lidar, 2);
}

// The paper's sizes: radii of 5 m and voxels of 0.1 m. Features stay with their points.
TEST(PaperCurves, VariantsAreTheirFilters) {
  const ScanPair pair = Simulated();
  const PreparedPair scans = PrepareForPaper(pair.source, pair.target, 2);
  const SE3d T = *pair.T_predicted;
  const auto expect = [&](Variant variant, const PointCloud& source, const PointCloud& target) {
    const PreparedPair filtered = Filtered(scans, variant, T, 2);
    EXPECT_EQ(filtered.source.cloud().x, source.x);
    EXPECT_EQ(filtered.target.cloud().x, target.x);
    ASSERT_TRUE(filtered.source.features());
    EXPECT_EQ(filtered.source.features()->edge.size(), source.size());
  };
  expect(Variant::kPlain, pair.source, pair.target);
  expect(Variant::kReciprocal, pair.source, pair.target);
  const KeptPoints blind = ArtificialBlindSpots(pair.source, pair.target, 5);
  const PointCloud blind_source = pair.source.Select(blind.source);
  const PointCloud blind_target = pair.target.Select(blind.target);
  ASSERT_LT(blind_source.size(), pair.source.size());
  expect(Variant::kBlindSpot, blind_source, blind_target);
  const KeptPoints ego = EgoBlindSpotFilter(blind_source, blind_target, T, 5);
  const PointCloud ego_source = blind_source.Select(ego.source);
  ASSERT_LT(ego_source.size(), blind_source.size());
  expect(Variant::kEgoFilter, ego_source, blind_target.Select(ego.target));
  const KeptPoints octree = OctreeCorrespondenceFilter(pair.source, pair.target, T, {0.1});
  expect(Variant::kOctree, pair.source.Select(octree.source), pair.target.Select(octree.target));
  const PreparedPair filtered = Filtered(scans, Variant::kOctree, T, 2);
  EXPECT_EQ(filtered.source.features()->edge, scans.source.features()->Select(octree.source).edge);
  EXPECT_GT(filtered.source.features()->num_edge, 50U);
}

// The prediction is the estimate of the filters, the path leads from the identity to the truth, and
// every curve is that of its own variant.
TEST(PaperCurves, AreThoseOfTheirVariants) {
  const ScanPair pair = Simulated();
  const SE3d T_truth = *pair.T_ground_truth;
  CurveOptions options;
  options.samples = 2;
  options.u_min = 0;
  options.u_max = 1;
  options.threads = 2;
  const std::vector<FigureCurve> wanted = {
      {"plain", "point_to_point", Variant::kPlain, "", "", ""},
      {"reciprocal", "point_to_point", Variant::kReciprocal, "", "", ""},
      {"octree", "point_to_point", Variant::kOctree, "", "", ""}};
  std::vector<int> progress;
  const auto curves =
      EvaluatePaperCurves(PrepareForPaper(pair.source, pair.target, 2), T_truth, *pair.T_predicted,
                          wanted, options, [&](int done) { progress.push_back(done); });
  EXPECT_EQ(progress, (std::vector<int>{1, 2, 3, 4, 5, 6}));
  const auto expect = [&](const char* file, const PointCloud& source, const PointCloud& target,
                          const MatchingOptions& matching) {
    const ClosestPointMatcher matcher(source, target, matching);
    const Objective objective("point_to_point", matcher);
    const std::vector<CurvePoint>& points = curves.at(file).curve.points;
    ASSERT_EQ(points.size(), 2U);
    EXPECT_DOUBLE_EQ(points[0].rmse, objective.Evaluate(SE3d(), 1).Rmse()) << file;
    EXPECT_NEAR(points[1].rmse, objective.Evaluate(T_truth, 1).Rmse(), 1e-9) << file;
    double pairs = 0;
    for (const Pull& pull : curves.at(file).pulls) {
      pairs += pull.group.find(" m") != std::string::npos ? pull.n_0 : 0;
    }
    EXPECT_EQ(pairs, static_cast<double>(points[0].n)) << file;
  };
  expect("plain", pair.source, pair.target, {});
  MatchingOptions strict;
  strict.reciprocal_epsilon_m = 0;
  expect("reciprocal", pair.source, pair.target, strict);
  const KeptPoints octree =
      OctreeCorrespondenceFilter(pair.source, pair.target, *pair.T_predicted, {0.1});
  expect("octree", pair.source.Select(octree.source), pair.target.Select(octree.target), {});
}

}  // namespace
}  // namespace icpscape
