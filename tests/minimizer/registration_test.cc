// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/registration.h"

#include <gtest/gtest.h>

#include "icpscape/common/error.h"
#include "icpscape/objective/loss.h"
#include "tests/minimizer/room.h"

namespace icpscape {
namespace {

using testing_support::AngleRad;
using testing_support::DistanceM;
using testing_support::kMotion;

const std::vector<std::string> kPlane = {"point_to_plane"};

PreparedPair Prepared(PointCloud source, PointCloud target) {
  PreparationOptions options;
  options.normals.num_neighbors = kRobustNormalNeighbors;
  return PreparePair(std::move(source), std::move(target), NeedsOf(kPlane, {}), options, 2);
}

// The room; a third of the source are walls that the target did not see.
PreparedPair PartUnseen(double scale = 1) {
  const testing_support::MovedRoom& room = testing_support::RoomOfKMotion();
  PointCloud source = room.source;
  PointCloud target = room.target;
  for (std::size_t i = 0; i < source.size(); i += 3) {
    source.x[i] = 1.3F * source.x[i] + 2.0F;
    source.y[i] = 0.8F * source.y[i] - 1.0F;
  }
  for (PointCloud* cloud : {&source, &target}) {
    for (auto* array : {&cloud->x, &cloud->y, &cloud->z}) {
      for (float& number : *array) {
        number *= static_cast<float>(scale);
      }
    }
  }
  return Prepared(std::move(source), std::move(target));
}

Registered Found(const PreparedPair& scans, Preset preset, const SE3d& T_start,
                 MinimizerOptions options = {}) {
  if (options.threads == 1) {
    options.threads = 2;
  }
  return Registration(scans, kPlane, {}, {}, preset, 2).Run(T_start, options);
}

TEST(Registration, PaperIsOneLoopOverTheObjectiveOfTheOptions) {
  const PreparedPair scans = PartUnseen();
  ObjectiveSetOptions options;
  options.matching.max_distance_m = 0.7;
  options.loss = MakeLoss("cauchy", 0.05);
  const ObjectiveSet set(scans, kPlane, options);
  const MinimizerSummary alone = Minimize(set.objectives().front(), kMotion, {});
  const Registered registered =
      Registration(scans, kPlane, {}, options, Preset::kPaper, 1).Run(kMotion, {});
  ASSERT_EQ(registered.summary.iterates.size(), alone.iterates.size());
  EXPECT_EQ(registered.summary.T_target_source().Matrix(), alone.T_target_source().Matrix());
  ASSERT_EQ(registered.stages.size(), 1U);
  EXPECT_EQ(registered.stages.front().max_distance_m, 0.7);
}

// From half a metre and 8 degrees off. The points are 10 to 20 cm apart.
TEST(Registration, RobustFindsTheMotionWherePartOfTheSourceIsUnseen) {
  const PreparedPair scans = PartUnseen();
  const SE3d start = kMotion * SE3d::Exp((Vec6() << 0.05, 0.03, 0.13, 0.4, -0.3, 0.1).finished());
  const Registered all = Found(scans, Preset::kPaper, start);
  EXPECT_GT(DistanceM(kMotion, all.summary.T_target_source()), 0.045);
  const Registered robust = Found(scans, Preset::kRobust, start);
  EXPECT_EQ(robust.summary.termination, Termination::kConverged);
  EXPECT_LT(DistanceM(kMotion, robust.summary.T_target_source()), 0.015);
  EXPECT_LT(AngleRad(kMotion, robust.summary.T_target_source()), 0.001);
  // All pairs, then shorter and shorter ones, then the loss.
  ASSERT_GE(robust.stages.size(), 4U);
  EXPECT_EQ(robust.stages.front().max_distance_m, 0);
  for (std::size_t i = 2; i < robust.stages.size(); ++i) {
    EXPECT_LE(robust.stages[i].max_distance_m, robust.stages[i - 1].max_distance_m);
    EXPECT_GT(robust.stages[i].first_iterate, robust.stages[i - 1].first_iterate);
  }
  EXPECT_TRUE(robust.stages[1].loss_scales.empty());
  ASSERT_EQ(robust.stages.back().loss_scales.size(), 1U);
  EXPECT_GT(robust.stages.back().loss_scales[0], 0);
  // What is judged is the last stage's: its cost at the pose is the one that is told.
  const Evaluation at_end = robust.objective.Evaluate(robust.summary.T_target_source(), 1);
  EXPECT_DOUBLE_EQ(at_end.sums.cost, robust.summary.final_cost());
  EXPECT_NE(robust.objective.objectives().front().loss(), nullptr);
}

TEST(Registration, RobustDoesNotDependOnTheUnitOfLength) {
  const SE3d start = SE3d::Exp((Vec6() << 0, 0, 0.1, 0.3, 0.1, 0).finished());
  const auto motion = [&](double scale) {
    MinimizerOptions options;
    options.min_step_m *= scale;
    const Registered registered =
        Found(PartUnseen(scale), Preset::kRobust, SE3d(start.R(), scale * start.t()), options);
    const SE3d& T = registered.summary.T_target_source();
    return SE3d(T.R(), T.t() / scale);
  };
  const SE3d metres = motion(1);
  // Powers of two leave every rounding as it is.
  EXPECT_LT(DistanceM(metres, motion(1.0 / 1024)), 1e-6);
  EXPECT_LT(AngleRad(metres, motion(1.0 / 1024)), 1e-6);
}

TEST(Registration, RobustIsTheSameForAnyNumberOfThreads) {
  const PreparedPair scans = PartUnseen();
  const auto poses = [&](int threads) {
    MinimizerOptions options;
    options.threads = threads;
    return Registration(scans, kPlane, {}, {}, Preset::kRobust, threads)
        .Run(SE3d(), options)
        .summary.T_target_source()
        .Matrix();
  };
  EXPECT_EQ(poses(1), poses(3));
}

TEST(Registration, RobustFitsEqualClouds) {
  const testing_support::MovedRoom& room = testing_support::RoomOfKMotion();
  const Registered registered =
      Found(Prepared(room.target, room.target), Preset::kRobust,
            SE3d::Exp((Vec6() << 0, 0.01, 0.02, 0.05, 0, 0.02).finished()));
  EXPECT_TRUE(registered.summary.Usable());
  EXPECT_LT(DistanceM(SE3d(), registered.summary.T_target_source()), 1e-5);
}

TEST(Registration, RobustEndsWhereItsObserverSays) {
  MinimizerOptions options;
  int calls = 0;
  options.observer = [&](const Observation&) { return ++calls < 3; };
  const Registered registered = Found(PartUnseen(), Preset::kRobust, SE3d(), options);
  EXPECT_EQ(registered.summary.termination, Termination::kStopped);
  EXPECT_EQ(calls, 3);
}

TEST(Registration, RobustRefusesWhatItSetsByItself) {
  const PreparedPair scans = PartUnseen();
  ObjectiveSetOptions gated;
  gated.matching.max_distance_m = 1;
  EXPECT_THROW(Registration(scans, kPlane, {}, gated, Preset::kRobust, 1), UsageError);
  ObjectiveSetOptions with_loss;
  with_loss.loss = MakeLoss("huber", 0.1);
  EXPECT_THROW(Registration(scans, kPlane, {}, with_loss, Preset::kRobust, 1), UsageError);
  EXPECT_THROW(Registration(scans, {"planar_to_plane"}, {}, {}, Preset::kRobust, 1), UsageError);
  MinimizerOptions every_evaluation;
  every_evaluation.reassociation = Reassociation::kEveryEvaluation;
  EXPECT_THROW(
      Registration(scans, kPlane, {}, {}, Preset::kRobust, 1).Run(SE3d(), every_evaluation),
      UsageError);
}

}  // namespace
}  // namespace icpscape
