// SPDX-License-Identifier: BSD-3-Clause
#include "src/paper/pair.h"

#include <gtest/gtest.h>

#include "src/common/error.h"
#include "src/filtering/ego_blind_spot.h"
#include "src/filtering/octree_correspondence_filter.h"
#include "src/simulation/scenes.h"

namespace icpscape {
namespace {

PaperPair Prepared() {
  LidarOptions lidar;
  lidar.azimuth_step_deg = 1;
  SimulatedPair simulated = SimulatePair("highway", 1, lidar, 2);
  PaperPair pair;
  pair.source = std::move(simulated.source);
  pair.target = std::move(simulated.target);
  pair.T_target_source = simulated.T_target_source;
  pair.T_prior = simulated.T_prior;
  PrepareForMetrics(2, &pair);
  return pair;
}

// The paper's sizes: radii of 5 m and voxels of 0.1 m. Features stay with their points.
TEST(PaperPair, VariantsAreTheirFilters) {
  const PaperPair pair = Prepared();
  const SE3d T = pair.T_prior;
  const auto expect = [&](Variant variant, const PointCloud& source, const PointCloud& target) {
    const PaperPair filtered = Filtered(pair, variant, T);
    EXPECT_EQ(filtered.source.x, source.x);
    EXPECT_EQ(filtered.target.x, target.x);
    EXPECT_EQ(filtered.features.edge.size(), source.size());
  };
  expect(Variant::kPlain, pair.source, pair.target);
  expect(Variant::kReciprocal, pair.source, pair.target);
  const FilteredPair blind = ArtificialBlindSpots(pair.source, pair.target, 5);
  ASSERT_LT(blind.source.size(), pair.source.size());
  expect(Variant::kBlindSpot, blind.source, blind.target);
  const FilteredPair ego = EgoBlindSpotFilter(blind.source, blind.target, T, 5);
  ASSERT_LT(ego.source.size(), blind.source.size());
  expect(Variant::kEgoFilter, ego.source, ego.target);
  const FilteredPair octree = OctreeCorrespondenceFilter(pair.source, pair.target, T, {0.1});
  expect(Variant::kOctree, octree.source, octree.target);
  const PaperPair filtered = Filtered(pair, Variant::kOctree, T);
  EXPECT_EQ(filtered.features.edge, pair.features.Select(octree.keep_source).edge);
  EXPECT_GT(filtered.features.num_edge, 50U);
}

// The prior is the estimate of the filters, the path leads from the identity to the truth, and
// every curve is that of its own variant.
TEST(PaperPair, CurvesAreThoseOfTheirVariants) {
  const PaperPair pair = Prepared();
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
      EvaluatePaperCurves(pair, wanted, options, [&](int done) { progress.push_back(done); });
  EXPECT_EQ(progress, (std::vector<int>{1, 2, 3, 4, 5, 6}));
  const auto expect = [&](const char* file, const PointCloud& source, const PointCloud& target,
                          const MatchingOptions& matching) {
    const ClosestPointMatcher matcher(source, target, matching);
    const Objective objective("point_to_point", matcher);
    const std::vector<CurvePoint>& points = curves.at(file).curve.points;
    ASSERT_EQ(points.size(), 2U);
    EXPECT_DOUBLE_EQ(points[0].rmse, objective.Evaluate(SE3d(), 1).Rmse()) << file;
    EXPECT_NEAR(points[1].rmse, objective.Evaluate(pair.T_target_source, 1).Rmse(), 1e-9) << file;
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
  const FilteredPair octree =
      OctreeCorrespondenceFilter(pair.source, pair.target, pair.T_prior, {0.1});
  expect("octree", octree.source, octree.target, {});
}

}  // namespace
}  // namespace icpscape
