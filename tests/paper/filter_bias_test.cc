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
  const ErrorAxis along = AlongPath(kMotion, Vec3::Zero(), 0.3);
  const ErrorAxis yaw = Yaw(kMotion, Vec3::Zero(), 0.5);
  EXPECT_LT((along.pose(0).t() - kMotion.t()).norm(), 1e-12);
  EXPECT_NEAR((along.pose(0.3).t() - kMotion.t()).norm(), 0.3, 1e-12);
  EXPECT_GT(along.pose(0.3).t().norm(), kMotion.t().norm());
  EXPECT_EQ((yaw.pose(0.5).t() - kMotion.t()).norm(), 0);
  EXPECT_NEAR((kMotion.Inverse() * yaw.pose(0.5)).LogRotation().z(), 0.5 * M_PI / 180, 1e-12);
  EXPECT_THROW(AlongPath(SE3d(), Vec3::Zero(), 0.3), UsageError);
}

TEST(FilterBias, ArgminOfAnUnfilteredPairIsTheTruth) {
  PointCloud target = testing_support::Room(3000, 1, SE3d(), 0.005);
  const PointCloud source = testing_support::Room(3000, 2, kMotion.Inverse(), 0.005);
  EstimateNormals({}, 2, &target);
  const ClosestPointMatcher matcher(source, target);
  const Objective objective("point_to_plane", matcher);
  EXPECT_NEAR(ArgminError(objective, AlongPath(kMotion, Vec3::Zero(), 0.3), 41, 2), 0, 0.02);
  EXPECT_NEAR(ArgminError(objective, Yaw(kMotion, Vec3::Zero(), 0.5), 41, 2), 0, 0.2);
  EXPECT_EQ(ArgminError(objective, AlongPath(kMotion, Vec3::Zero(), 0.3), 41, 1),
            ArgminError(objective, AlongPath(kMotion, Vec3::Zero(), 0.3), 41, 2));
  EXPECT_THROW(ArgminError(objective, Yaw(kMotion, Vec3::Zero(), 0.5), 2, 1), UsageError);
}

// Two points 5 m apart across the motion: at the error e of the way the residual is
// sqrt((e - offset)^2 + 5^2), all but a parabola. The least sample is up to half a step of 0.03 m
// off; its neighbours tell where the vertex is.
TEST(FilterBias, ArgminIsTheVertexBetweenSamples) {
  const SE3d motion(Mat3::Identity(), Vec3(2, 0, 0));
  const auto argmin = [&](double offset) {
    PointCloud source, target;
    testing_support::AddPoint(Vec3(10, 0, 0), &source);
    testing_support::AddPoint(Vec3(12 + offset, 5, 0), &target);
    const ClosestPointMatcher matcher(source, target);
    return ArgminError(Objective("point_to_point", matcher), AlongPath(motion, Vec3::Zero(), 0.3),
                       41, 1);
  };
  for (const double offset : {0.0, 0.1, -0.107, 0.25, 0.55}) {  // Also beyond the range of 0.3 m.
    EXPECT_NEAR(argmin(offset), offset, 1e-4) << offset;
  }
  EXPECT_NEAR(argmin(1), 0.6, 1e-12);  // The sweep ends at twice the range.
  EXPECT_NEAR(argmin(-1), -0.6, 1e-12);
}

TEST(FilterBias, ArgminNeedsPairsAtEveryPose) {
  PointCloud source, target;
  testing_support::AddPoint(Vec3(10, 0, 0), &source);
  testing_support::AddPoint(Vec3(10.6, 0, 0), &target);
  const ClosestPointMatcher matcher(source, target, {0.5});  // At 0.6 m but not at -0.6 m.
  EXPECT_THROW(ArgminError(Objective("point_to_point", matcher),
                           AlongPath(kMotion, Vec3::Zero(), 0.3), 41, 1),
               ComputationError);
}

TEST(FilterBias, RegressionSlope) {
  // By hand: means 7/3 and 4; sum of products 10 and of squares 14/3.
  EXPECT_NEAR(RegressionSlope({1, 2, 4}, {1, 5, 6}), (4.0 + -1.0 / 3 + 10.0 / 3) / (14.0 / 3),
              1e-12);
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
  // The same under a motion: the source is seen from 5 m further on.
  PointCloud seen = source;
  for (float& x : seen.x) {
    x -= 5;
  }
  const SE3d motion(Mat3::Identity(), Vec3(5, 0, 0));
  const DynamicRemains moved =
      FindDynamicRemains(seen, target, {0, 1, 1, 1, 1}, motion, 0.15, is_dynamic);
  EXPECT_EQ(moved.overlapping, 1U);
  EXPECT_EQ(moved.kept_overlapping, 0U);
  // Two metres off is near where the reach is so long.
  EXPECT_EQ(FindDynamicRemains(seen, target, {0, 1, 1, 1, 1}, motion, 2.1, is_dynamic).overlapping,
            2U);
  source.label.clear();
  EXPECT_THROW(FindDynamicRemains(source, target, {1, 0, 1, 1, 1}, SE3d(), 0.15, is_dynamic),
               InputError);
}

}  // namespace
}  // namespace icpscape
