// SPDX-License-Identifier: BSD-3-Clause
// Curves over a few points, whose values are computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "icpscape/landscape/curve.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

// One pair, moved along x from 1 m off: rmse = |u - 1|.
struct StraightLine {
  PointCloud source, target;
  std::optional<ClosestPointMatcher> matcher;
  Path path{SE3d(), SE3d(Mat3::Identity(), Vec3(1, 0, 0)), PathKind::kLerpSlerp};
  StraightLine() {
    testing_support::AddPoint({5, 0, 0}, &source);
    testing_support::AddPoint({6, 0, 0}, &target);
    matcher.emplace(source, target);
  }
  std::vector<CurvePoint> Points(const CurveOptions& options) const {
    return EvaluateCurves({Objective("point_to_point", *matcher)}, path, options)[0].points;
  }
};

TEST(CurveByHand, TwoSamplesHaveTheSlopeBetweenThem) {
  CurveOptions options;
  options.samples = 2;
  options.u_min = -0.5;
  options.u_max = 1.75;
  const std::vector<CurvePoint> points = StraightLine().Points(options);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[0].rmse, 1.5, 1e-12);
  EXPECT_NEAR(points[1].rmse, 0.75, 1e-12);
  for (const CurvePoint& p : points) {
    EXPECT_NEAR(p.slope_numeric, -0.75 / 2.25, 1e-12);
  }
  EXPECT_NEAR(points[0].slope_analytic, -1, 1e-12);
  EXPECT_NEAR(points[1].slope_analytic, 1, 1e-12);
}

// The root's slope is 0/0 where the fit is perfect.
TEST(CurveByHand, SlopeIsZeroWhereTheRmseIs) {
  CurveOptions options;
  options.u_min = 0;
  options.u_max = 2;
  options.samples = 3;
  const std::vector<CurvePoint> points = StraightLine().Points(options);
  EXPECT_EQ(points[1].u, 1);
  EXPECT_EQ(points[1].rmse, 0);
  EXPECT_EQ(points[1].slope_analytic, 0);
  EXPECT_NEAR(points[0].slope_analytic, -1, 1e-12);
  EXPECT_NEAR(points[2].slope_analytic, 1, 1e-12);
}

// Of the five source points two have a match within 0.5 m at u = 0, one at u = 1: the inlier ratio,
// and the reading by the n of u = 1.
TEST(CurveByHand, InlierRatioAndFixedNByHand) {
  PointCloud source, target;
  for (int i = 0; i < 5; ++i) {
    testing_support::AddPoint({10.0 * i, 0, 0}, &source);
  }
  testing_support::AddPoint({0, 0.3, 0}, &target);
  testing_support::AddPoint({10, 0.4, 0}, &target);
  testing_support::AddPoint({21, 0.1, 0}, &target);
  const ClosestPointMatcher matcher(source, target, {0.5});
  CurveOptions options;
  options.u_min = 0;
  options.u_max = 1;
  options.samples = 2;
  const Path path(SE3d(), SE3d(Mat3::Identity(), Vec3(1, 0, 0)), PathKind::kLerpSlerp);
  const auto points =
      EvaluateCurves({Objective("point_to_point", matcher)}, path, options)[0].points;
  EXPECT_EQ(points[0].n, 2);
  EXPECT_NEAR(points[0].inlier_ratio, 0.4, 1e-15);
  EXPECT_NEAR(points[0].epsilon, 0.25, 1e-7);
  EXPECT_NEAR(points[0].cost, 0.125, 1e-7);
  EXPECT_NEAR(points[0].rmse, std::sqrt(0.125), 1e-7);
  EXPECT_NEAR(points[0].rmse_fixed_n, 0.5, 1e-7);
  EXPECT_EQ(points[1].n, 1);
  EXPECT_NEAR(points[1].inlier_ratio, 0.2, 1e-15);
  EXPECT_NEAR(points[1].rmse_fixed_n, 0.1, 1e-7);
}

TEST(CurveByHand, MinimumIsOfTheColumnAskedForAndTheFirstOfSeveral) {
  Curve curve;
  curve.points.resize(4);
  const double rmse[] = {3, 1, 2, 1}, epsilon[] = {5, 6, 4, 7};
  for (std::size_t i = 0; i < 4; ++i) {
    curve.points[i].rmse = rmse[i];
    curve.points[i].epsilon = epsilon[i];
  }
  EXPECT_EQ(&curve.Minimum(), &curve.points[1]);
  EXPECT_EQ(&curve.Minimum(&CurvePoint::epsilon), &curve.points[2]);
}

TEST(CurveByHand, ReportsEveryPoseThatIsDone) {
  CurveOptions options;
  options.samples = 5;
  options.threads = 2;
  std::vector<int> done;
  const StraightLine line;
  EvaluateCurves({Objective("point_to_point", *line.matcher)}, line.path, options,
                 [&](int count) { done.push_back(count); });
  EXPECT_EQ(done, (std::vector<int>{1, 2, 3, 4, 5}));
}

TEST(CurveByHand, SlopesAreExactForAStraightLine) {
  CurveOptions options;
  options.u_max = 0.5;
  options.samples = 4;
  for (const CurvePoint& p : StraightLine().Points(options)) {
    EXPECT_NEAR(p.rmse, 1 - p.u, 1e-12);
    EXPECT_NEAR(p.slope_numeric, -1, 1e-12);
    EXPECT_NEAR(p.slope_analytic, -1, 1e-12);
    EXPECT_EQ(p.n, 1);
    EXPECT_EQ(p.inlier_ratio, 1);
  }
}

}  // namespace
}  // namespace icpscape
