// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/objective_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/objective/loss.h"
#include "icpscape/residuals/registry.h"
#include "tests/support/message_of.h"
#include "tests/support/prepared.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing_support::AsPrepared;
using testing_support::MessageOf;

const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.3, 0.05, -0.02).finished());

// A room twice, with classes by hand: every third point is an edge, every third planar.
struct Scene {
  testing_support::MovedRoom room{4000, kMotion};
  Features features;
  Scene() {
    for (std::size_t i = 0; i < room.source.size(); ++i) {
      features.edge.push_back(i % 3 == 0 ? 1 : 0);
      features.planar.push_back(i % 3 == 1 ? 1 : 0);
    }
  }
};

const Scene& TheScene() {
  static const Scene scene;
  return scene;
}

ObjectiveSetOptions Lenient() {  // A random room has few edges as sharp as the paper's rules want.
  ObjectiveSetOptions options;
  options.matching.max_distance_m = 1;
  options.line.eigenvalue_ratio = options.patch.eigenvalue_ratio = 1.5;
  options.patch.max_smallest_eigenvalue_m2 = 1;
  options.loss = MakeLoss("huber", 0.1);
  return options;
}

void ExpectSame(const ObjectiveSet& a, const ObjectiveSet& b) {
  ASSERT_EQ(a.objectives().size(), b.objectives().size());
  for (std::size_t i = 0; i < a.objectives().size(); ++i) {
    for (const SE3d& T : {SE3d(), kMotion}) {
      const Evaluation x = a.objectives()[i].Evaluate(T, 2);
      const Evaluation y = b.objectives()[i].Evaluate(T, 2);
      EXPECT_GT(x.n(), 100) << i;
      EXPECT_EQ(x.n(), y.n()) << i;
      EXPECT_EQ(x.sums.cost, y.sums.cost) << i;
      EXPECT_EQ(x.sums.gradient, y.sums.gradient) << i;
      EXPECT_EQ(x.sums.Hessian(), y.sums.Hessian()) << i;
    }
  }
}

TEST(ObjectiveSet, IsTheSameOverCloudsThatAreSearchableAlready) {
  const testing_support::MovedRoom& room = TheScene().room;
  const Features& features = TheScene().features;
  std::vector<std::string> all;
  ForEachMetric([&](auto tag) { all.emplace_back(decltype(tag)::Metric::kName); });
  const PointCloud edges = room.source.Select(features.edge);
  const PointCloud planar = room.source.Select(features.planar);
  const SearchableCloud target(room.target);
  const MetricClouds sources{SearchableCloud(room.source), SearchableCloud(edges),
                             SearchableCloud(planar)};
  const auto expect_same = [&](const std::vector<std::string>& metrics) {
    ExpectSame(ObjectiveSet(AsPrepared(room.source, room.target, features), metrics, Lenient()),
               ObjectiveSet(sources, {target, target, target}, metrics, Lenient()));
  };
  expect_same(all);
  for (const std::string& metric : all) {
    expect_same({metric});
  }
}

// Every kind of metric takes its own options, and all the loss: with a gate that lets nothing
// through, the metrics of that kind alone have no pairs.
TEST(ObjectiveSet, GivesEachKindOfMetricItsOwnOptions) {
  const testing_support::MovedRoom& room = TheScene().room;
  const std::vector<std::string> metrics = {"point_to_point", "edge_to_line", "planar_to_patch"};
  for (std::size_t gated = 0; gated < 3; ++gated) {
    ObjectiveSetOptions options = Lenient();
    const double gate = 1e-7;
    (gated == 0   ? options.matching.max_distance_m
     : gated == 1 ? options.line.max_neighbor_distance_m
                  : options.patch.max_neighbor_distance_m) = gate;
    options.line.triangle_leg_m = 0.7;
    options.patch.triangle_leg_m = 0.3;
    const ObjectiveSet set(AsPrepared(room.source, room.target, TheScene().features), metrics,
                           options);
    for (std::size_t m = 0; m < 3; ++m) {
      const Objective& objective = set.objectives()[m];
      EXPECT_EQ(objective.Evaluate(kMotion, 2).n() == 0, m == gated) << metrics[m];
      EXPECT_EQ(objective.loss(), options.loss.get());
    }
    EXPECT_DOUBLE_EQ(set.objectives()[2].matcher().area_patch(), 0.09);
  }
}

TEST(ObjectiveSet, KnowsWhichMetricsNeedFeatures) {
  for (const char* metric :
       {"edge_to_line", "edge_to_line_distance", "planar_to_patch", "planar_to_plane"}) {
    EXPECT_TRUE(NeedsFeatures(metric)) << metric;
  }
  for (const char* metric : {"point_to_point", "point_to_plane", "symmetric", "symmetric_rotated",
                             "symmetric_split", "two_plane"}) {
    EXPECT_FALSE(NeedsFeatures(metric)) << metric;
  }
}

// LOAM's maps: edges are matched to the edges alone.
TEST(ObjectiveSet, GivesEachKindOfMetricItsOwnClouds) {
  const testing_support::MovedRoom& room = TheScene().room;
  const Features& features = TheScene().features;
  const PointCloud edges = room.target.Select(features.edge);
  const PointCloud planar = room.target.Select(features.planar);
  const MetricClouds sources{SearchableCloud(room.source), SearchableCloud(room.source),
                             SearchableCloud(room.source)};
  const MetricClouds targets{SearchableCloud(room.target), SearchableCloud(edges),
                             SearchableCloud(planar)};
  const ObjectiveSet set(sources, targets, {"edge_to_line", "point_to_point", "planar_to_patch"},
                         Lenient());
  Features everything{std::vector<char>(room.source.size(), 1),
                      std::vector<char>(room.source.size(), 1)};
  const auto alone = [&](const PointCloud& target, const char* metric) {
    const ObjectiveSet one(AsPrepared(room.source, target, everything), {metric}, Lenient());
    return one.objectives()[0].Evaluate(kMotion, 1).sums.cost;
  };
  const auto cost = [&](std::size_t i) {
    return set.objectives()[i].Evaluate(kMotion, 1).sums.cost;
  };
  EXPECT_EQ(cost(0), alone(edges, "edge_to_line"));
  EXPECT_EQ(cost(1), alone(room.target, "point_to_point"));
  EXPECT_EQ(cost(2), alone(planar, "planar_to_patch"));
  EXPECT_NE(cost(0), alone(room.target, "edge_to_line"));
}

TEST(ObjectiveSet, RefusesAMetricWithoutPoints) {
  const testing_support::MovedRoom& room = TheScene().room;
  const PointCloud none;
  const SearchableCloud target(room.target);
  for (const char* metric : {"edge_to_line", "point_to_plane", "planar_to_patch"}) {
    const MetricClouds empty{SearchableCloud(none), SearchableCloud(none), SearchableCloud(none)};
    EXPECT_EQ(MessageOf<ComputationError>([&] {
                ObjectiveSet(empty, {target, target, target}, {metric}, Lenient());
              }),
              metric + std::string(": no source point is left for it; expected at least one."));
  }
}

// A map may have no edges.
TEST(ObjectiveSet, MatchesNothingInAnEmptyTarget) {
  const testing_support::MovedRoom& room = TheScene().room;
  PointCloud none;
  const MetricClouds sources{SearchableCloud(room.source), SearchableCloud(room.source),
                             SearchableCloud(room.source)};
  const MetricClouds empty{SearchableCloud(none), SearchableCloud(none), SearchableCloud(none)};
  const ObjectiveSet set(sources, empty, {"edge_to_line", "point_to_plane", "planar_to_patch"},
                         Lenient());
  for (const Objective& objective : set.objectives()) {
    EXPECT_EQ(objective.Evaluate(kMotion, 2).n(), 0);
  }
}

TEST(ObjectiveSet, RefusesMetricsWhoseCloudsAreMissing) {
  const testing_support::MovedRoom& room = TheScene().room;
  const SearchableCloud all(room.source);
  const MetricClouds points{all, {}, {}};
  const MetricClouds edges{{}, all, {}};
  const auto message = [](const MetricClouds& clouds, const char* metric) {
    return testing_support::MessageOf<UsageError>(
        [&] { ObjectiveSet(clouds, clouds, {metric}, Lenient()); });
  };
  EXPECT_THAT(message(points, "edge_to_line"), ::testing::HasSubstr("needs clouds of edges;"));
  EXPECT_THAT(message(points, "planar_to_patch"),
              ::testing::HasSubstr("needs clouds of planar points;"));
  EXPECT_THAT(message(edges, "symmetric"), ::testing::HasSubstr("needs clouds of points;"));
}

}  // namespace
}  // namespace icpscape
