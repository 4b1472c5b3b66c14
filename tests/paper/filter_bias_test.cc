// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/filter_bias.h"

#include <gtest/gtest.h>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

const SE3d kMotion = SE3d::Exp((Vec6() << 0, 0, 0.02, 0.6, 0.05, 0).finished());

TEST(FilterBias, AxesPassThroughTheTruthInTheirUnits) {
  const ErrorAxis along = AlongPath(kMotion, 0.3);
  const ErrorAxis yaw = Yaw(kMotion, 0.5);
  EXPECT_LT((along.pose(0).t() - kMotion.t()).norm(), 1e-12);
  EXPECT_NEAR((along.pose(0.3).t() - kMotion.t()).norm(), 0.3, 1e-12);
  EXPECT_GT(along.pose(0.3).t().norm(), kMotion.t().norm());
  EXPECT_EQ((yaw.pose(0.5).t() - kMotion.t()).norm(), 0);
  EXPECT_NEAR((kMotion.Inverse() * yaw.pose(0.5)).LogRotation().z(), 0.5 * M_PI / 180, 1e-12);
  EXPECT_THROW(AlongPath(SE3d(), 0.3), UsageError);
}

TEST(FilterBias, ArgminOfAnUnfilteredPairIsTheTruth) {
  PointCloud target = testing_support::Room(3000, 1, SE3d(), 0.005);
  const PointCloud source = testing_support::Room(3000, 2, kMotion.Inverse(), 0.005);
  EstimateNormals({}, 2, &target);
  const ClosestPointMatcher matcher(source, target);
  const Objective objective("point_to_plane", matcher);
  EXPECT_NEAR(ArgminError(objective, AlongPath(kMotion, 0.3), 41, 2), 0, 0.02);
  EXPECT_NEAR(ArgminError(objective, Yaw(kMotion, 0.5), 41, 2), 0, 0.2);
  EXPECT_EQ(ArgminError(objective, AlongPath(kMotion, 0.3), 41, 1),
            ArgminError(objective, AlongPath(kMotion, 0.3), 41, 2));
  EXPECT_THROW(ArgminError(objective, Yaw(kMotion, 0.5), 2, 1), UsageError);
}

TEST(FilterBias, RegressionSlope) {
  EXPECT_DOUBLE_EQ(RegressionSlope({-1, 0, 1}, {3, 5, 7}), 2);
  EXPECT_DOUBLE_EQ(RegressionSlope({-1, 0, 1}, {4, 4, 4}), 0);
}

TEST(FilterBias, RemainsOverlapWhereTheSameObjectIsNear) {
  PointCloud target;
  target.x = {10, 20};
  target.y = target.z = {0, 0};
  target.label = {252, 40};
  PointCloud source;
  source.x = {10.1F, 12, 20, 20.05F, 10};
  source.y = source.z = {0, 0, 0, 0, 0};
  source.label = {252, 252, 40, 252, 252 + 65536};  // The last is another car.
  const auto is_dynamic = [](std::int32_t label) { return (label & 0xFFFF) == 252; };
  const DynamicRemains remains =
      FindDynamicRemains(source, target, {1, 0, 1, 1, 1}, SE3d(), 0.15, is_dynamic);
  EXPECT_EQ(remains.dynamic, 4U);
  EXPECT_EQ(remains.overlapping, 1U);
  EXPECT_EQ(remains.kept, 3U);
  EXPECT_EQ(remains.kept_overlapping, 1U);
  source.label.clear();
  EXPECT_THROW(FindDynamicRemains(source, target, {1, 0, 1, 1, 1}, SE3d(), 0.15, is_dynamic),
               InputError);
}

}  // namespace
}  // namespace icpscape
