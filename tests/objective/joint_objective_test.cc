// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/joint_objective.h"

#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <memory>
#include <type_traits>
#include <utility>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/minimizer/minimizer.h"
#include "icpscape/objective/loss.h"
#include "icpscape/objective/objective_set.h"
#include "icpscape/residuals/adapters/ceres.h"
#include "tests/support/prepared.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing_support::AsPrepared;

struct RoomPair {
  PointCloud source = testing_support::Room(3000, 1, SE3d(), 0.005);
  PointCloud target = testing_support::Room(3000, 2, SE3d(), 0.005);
  Features features;
  RoomPair() {
    EstimateNormals({}, 1, &source);
    EstimateNormals({}, 1, &target);
    for (std::size_t i = 0; i < source.size(); ++i) {
      const bool pillar = i % 7 == 6;
      features.edge.push_back(pillar ? 1 : 0);
      features.planar.push_back(pillar ? 0 : 1);
    }
  }
};

TEST(JointObjective, IsTheWeightedSumAndWhatCeresSees) {
  const RoomPair room;
  ObjectiveSetOptions options;
  options.loss = MakeLoss("huber", 0.02);
  const ObjectiveSet set(AsPrepared(room.source, room.target, room.features),
                         {"edge_to_line", "planar_to_plane", "point_to_plane"}, options);
  const auto& o = set.objectives();
  const JointObjective joint(set.objectives(), {2, 0.5, 1});
  EXPECT_EQ(joint.Name(), "edge_to_line + planar_to_plane + point_to_plane");
  const SE3d T(Mat3::Identity(), Vec3(0.05, 0.02, 0));
  const MatchesByMatcher matches = joint.Match(T, 1);
  const Evaluation sum = joint.Evaluate(T, matches, 1);
  double cost = 0, squared = 0, epsilon = 0;
  Vec6 gradient = Vec6::Zero(), epsilon_gradient = Vec6::Zero();
  Mat6 hessian = Mat6::Zero();
  long n = 0;
  const double weights[] = {2, 0.5, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const Evaluation part = o[k].Evaluate(T, 1);
    cost += weights[k] * part.sums.cost;
    gradient += weights[k] * part.sums.gradient;
    hessian += weights[k] * part.sums.Hessian();
    squared += weights[k] * part.sum_squared;
    epsilon += weights[k] * part.epsilon;
    epsilon_gradient += weights[k] * part.epsilon_gradient;
    n += part.n();
  }
  const auto expect_sum = [&](const Evaluation& evaluation) {
    EXPECT_NEAR(evaluation.sums.cost, cost, 1e-12 * cost);
    EXPECT_LE((evaluation.sums.gradient - gradient).norm(), 1e-12 * gradient.norm());
    EXPECT_LE((evaluation.sums.Hessian() - hessian).norm(), 1e-12 * hessian.norm());
    EXPECT_NEAR(evaluation.sum_squared, squared, 1e-12 * squared);
    EXPECT_NEAR(evaluation.epsilon, epsilon, 1e-12 * epsilon);
    EXPECT_LE((evaluation.epsilon_gradient - epsilon_gradient).norm(),
              1e-12 * epsilon_gradient.norm());
    EXPECT_EQ(evaluation.n(), n);
    EXPECT_FALSE(evaluation.sums.upward_loss);
  };
  expect_sum(sum);
  MatchesByMatcher kept;
  expect_sum(joint.Evaluate(T, 2, &kept));
  ASSERT_EQ(kept.size(), matches.size());
  for (const auto& [matcher, found] : matches) {
    EXPECT_EQ(kept.at(matcher).target_index, found.target_index);
  }
  // What was not asked for stays zero.
  EXPECT_EQ(joint.Evaluate(T, matches, 1, Derivatives::kGradient).sums.gradient, sum.sums.gradient);
  EXPECT_EQ(joint.Evaluate(T, matches, 1, Derivatives::kGradient).sums.hessian, Mat6::Zero());
  EXPECT_EQ(joint.Evaluate(T, matches, 1, Derivatives::kNone).sums.gradient, Vec6::Zero());

  double x[7];
  T.ToParameters(x);
  ceres::Problem::Options borrowed;
  borrowed.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(borrowed);
  joint.AddResidualBlocks(matches, x, &problem);
  problem.SetManifold(x, new SE3Manifold);
  double ceres_cost = 0;
  std::vector<double> ceres_gradient;
  ASSERT_TRUE(problem.Evaluate({}, &ceres_cost, nullptr, &ceres_gradient, nullptr));
  EXPECT_NEAR(ceres_cost, cost, 1e-12 * cost);
  EXPECT_LE((Eigen::Map<const Vec6>(ceres_gradient.data()) - gradient).norm(), 1e-9);
}

// Whichever term it is, and whichever of its pairs.
TEST(JointObjective, KnowsAnUpwardLossOfAnyTerm) {
  const RoomPair room;
  const ClosestPointMatcher matcher(room.source, room.target);
  const Objective huber("point_to_plane", matcher, MakeLoss("huber", 0.1));
  const Objective tolerant("point_to_point", matcher, MakeLoss("tolerant", 0.1));
  const auto expect = [&](const JointObjective& joint, bool upward) {
    EXPECT_EQ(joint.HasUpwardLoss(), upward) << joint.Name();
    EXPECT_EQ(joint.Evaluate(SE3d(), 1).sums.upward_loss, upward) << joint.Name();
  };
  expect(JointObjective({huber, tolerant}, {0.5, 2}), true);
  expect(JointObjective({tolerant, huber}, {0.5, 2}), true);
  expect(JointObjective({huber, huber}, {0.5, 2}), false);
  expect(tolerant, true);
}

TEST(JointObjective, EdgesAndPlanesTogetherFindTheMotion) {
  const SE3d motion = SE3d::Exp((Vec6() << 0, 0, 0.01, 0.05, 0.03, 0).finished());
  RoomPair room;
  room.source = testing_support::Room(3000, 1, motion.Inverse(), 0.005);
  const ObjectiveSet set(AsPrepared(room.source, room.target, room.features),
                         {"edge_to_line", "planar_to_plane"}, {});
  const JointObjective joint(set.objectives(), {0.1, 1});
  const MinimizerSummary summary = Minimize(joint, SE3d(), {});
  ASSERT_TRUE(summary.Usable()) << summary.message;
  EXPECT_LT((motion.Inverse() * summary.T_target_source()).t().norm(), 0.01);
}

// What keeps a reference takes no temporary, which would die at once. A sum has copies of its
// objectives, and may be moved.
static_assert(!std::is_constructible_v<Objective, std::string, ClosestPointMatcher>);
static_assert(!std::is_constructible_v<Objective, const RegisteredMetric&, ClosestPointMatcher>);
static_assert(std::is_constructible_v<Objective, std::string, ClosestPointMatcher&>);
template <class Set, class = void>
constexpr bool kGivesObjectives = false;
template <class Set>
constexpr bool kGivesObjectives<Set, std::void_t<decltype(std::declval<Set>().objectives())>> =
    true;
static_assert(!kGivesObjectives<ObjectiveSet>);
static_assert(kGivesObjectives<const ObjectiveSet&>);

TEST(JointObjective, OutlivesTheObjectivesThatItIsMadeOf) {
  const RoomPair room;
  const ClosestPointMatcher matcher(room.source, room.target);
  auto objectives = std::make_unique<std::vector<Objective>>();
  objectives->emplace_back("point_to_plane", matcher, MakeLoss("huber", 0.01));
  objectives->emplace_back("point_to_point", matcher, nullptr);
  const SE3d T(Mat3::Identity(), Vec3(0.05, 0.02, 0));
  const double cost =
      2 * (*objectives)[0].Evaluate(T, 1).sums.cost + 3 * (*objectives)[1].Evaluate(T, 1).sums.cost;
  JointObjective made(*objectives, {2, 3});
  objectives.reset();
  const JointObjective moved = std::move(made);
  EXPECT_NEAR(moved.Evaluate(T, 1).sums.cost, cost, 1e-12 * cost);
}

TEST(JointObjective, RefusesWeightsThatAreNotPositive) {
  const RoomPair room;
  const ObjectiveSet set(AsPrepared(room.source, room.target, room.features), {"point_to_point"},
                         {});
  for (const double weight : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(JointObjective(set.objectives(), {weight}), UsageError);
  }
  EXPECT_THROW(JointObjective(set.objectives(), {1, 1}), UsageError);
}

TEST(ObjectiveSet, KindsShareAMatcherAndTakeTheirFeatures) {
  const RoomPair room;
  const ObjectiveSet set(AsPrepared(room.source, room.target, room.features),
                         {"point_to_point", "symmetric", "edge_to_line", "planar_to_patch",
                          "edge_to_line_distance", "planar_to_plane"},
                         {});
  const auto& o = set.objectives();
  EXPECT_EQ(&o[0].matcher(), &o[1].matcher());
  EXPECT_EQ(&o[2].matcher(), &o[4].matcher());
  EXPECT_EQ(&o[3].matcher(), &o[5].matcher());
  EXPECT_EQ(o[2].matcher().source().size(), 428U);  // Every seventh of 3000.
  EXPECT_EQ(o[3].matcher().source().size(), 2572U);
  Features none = room.features;
  none.edge.assign(none.edge.size(), 0);
  EXPECT_THROW(ObjectiveSet(AsPrepared(room.source, room.target, none), {"edge_to_line"}, {}),
               ComputationError);
}

}  // namespace
}  // namespace icpscape
