// SPDX-License-Identifier: BSD-3-Clause
#include "src/landscape/curve.h"

#include <gtest/gtest.h>

#include <memory>

#include "residuals/registry.h"
#include "src/cloud/normals.h"
#include "src/common/error.h"
#include "src/io/kitti.h"
#include "src/io/sequences.h"
#include "src/matching/closest_point_matcher.h"
#include "tests/support/matchers.h"
#include "tests/support/real_scans.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.6, 0.05, -0.02).finished());

const testing_support::MovedRoom& Room() {
  static const testing_support::MovedRoom room(3000, kMotion);
  return room;
}

/// Every registered metric over the room, each with a matcher of its own.
struct EveryMetric {
  std::vector<std::unique_ptr<Matcher>> matchers;
  std::vector<Objective> objectives;
  EveryMetric() {
    ForEachMetric([&](auto tag) {
      const char* metric = decltype(tag)::Metric::kName;
      matchers.push_back(testing_support::MatcherFor(metric, Room().source, Room().target));
      objectives.emplace_back(metric, *matchers.back());
    });
  }
};

TEST(Curve, DefaultGridHitsStartAndReferenceExactly) {
  const CurveOptions options;
  EXPECT_EQ(options.U(0), -1);
  EXPECT_EQ(options.U(33), 0);
  EXPECT_EQ(options.U(66), 1);
  EXPECT_EQ(options.U(99), 2);
}

TEST(Curve, MinimumLiesAtTheTruth) {
  const EveryMetric all;
  const std::vector<Objective>& objectives = all.objectives;
  CurveOptions options;
  options.threads = 2;
  for (const Curve& curve :
       EvaluateCurves(objectives, Path(SE3d(), kMotion, PathKind::kLerpSlerp), options)) {
    EXPECT_NEAR(curve.Minimum().u, 1, 0.07) << curve.metric;
  }
}

// With frozen pairs the curve is smooth and its slope is the gradient along the path.
TEST(Curve, FrozenSlopesAgree) {
  const EveryMetric all;
  const std::vector<Objective>& objectives = all.objectives;
  for (const PathKind kind : {PathKind::kLerpSlerp, PathKind::kGeodesic}) {
    const Path path(SE3d(), kMotion, kind);
    for (const double u : {-0.7, 0.0, 0.4, 1.6}) {
      constexpr double h = 1e-4;
      CurveOptions options;
      options.u_min = u - h;
      options.u_max = u + h;
      options.samples = 3;
      options.frozen_u = 1;
      for (const Curve& curve : EvaluateCurves(objectives, path, options)) {
        const CurvePoint& p = curve.points[1];
        EXPECT_NEAR(p.slope_analytic, p.slope_numeric, 1e-6 * (1 + std::abs(p.slope_numeric)))
            << curve.metric << " at u = " << u;
      }
    }
  }
}

TEST(Curve, SlopesAreExactForAStraightLine) {
  // One pair, point-to-point, moved along x: rmse = |u - 1|, whose slope is exactly -1 left of it.
  PointCloud source, target;
  testing_support::AddPoint({5, 0, 0}, &source);
  testing_support::AddPoint({6, 0, 0}, &target);
  const ClosestPointMatcher matcher(source, target);
  const std::vector<Objective> objectives = {Objective("point_to_point", matcher)};
  CurveOptions options;
  options.u_max = 0.5;
  options.samples = 4;
  const Path path(SE3d(), SE3d(Mat3::Identity(), Vec3(1, 0, 0)), PathKind::kLerpSlerp);
  const auto curves = EvaluateCurves(objectives, path, options);
  for (const CurvePoint& p : curves[0].points) {
    EXPECT_NEAR(p.rmse, 1 - p.u, 1e-12);
    EXPECT_NEAR(p.slope_numeric, -1, 1e-12);
    EXPECT_NEAR(p.slope_analytic, -1, 1e-12);
    EXPECT_EQ(p.n, 1);
    EXPECT_EQ(p.inlier_ratio, 1);
  }
}

TEST(Curve, NumericSlopesAreOfSecondOrderEverywhere) {
  const EveryMetric all;
  CurveOptions options;
  options.samples = 7;
  const double h = 0.5;
  const Path path(SE3d(), kMotion, PathKind::kLerpSlerp);
  for (const Curve& curve : EvaluateCurves(all.objectives, path, options)) {
    const auto& p = curve.points;
    EXPECT_NEAR(p[0].slope_numeric, (-1.5 * p[0].rmse + 2 * p[1].rmse - 0.5 * p[2].rmse) / h,
                1e-12);
    EXPECT_NEAR(p[3].slope_numeric, (p[4].rmse - p[2].rmse) / (2 * h), 1e-12);
    EXPECT_NEAR(p[6].slope_numeric, (1.5 * p[6].rmse - 2 * p[5].rmse + 0.5 * p[4].rmse) / h, 1e-12);
  }
}

TEST(Curve, ReadingsOfTheRmse) {
  const EveryMetric all;
  CurveOptions options;
  options.samples = 4;  // u = -1, 0, 1, 2.
  const Path path(SE3d(), kMotion, PathKind::kLerpSlerp);
  const auto per_term = EvaluateCurves(all.objectives, path, options);
  options.patch_offset = PatchOffset::kNone;
  const auto none = EvaluateCurves(all.objectives, path, options);
  options.patch_offset = PatchOffset::kTotal;
  const auto total = EvaluateCurves(all.objectives, path, options);
  for (std::size_t m = 0; m < per_term.size(); ++m) {
    const bool patch = per_term[m].metric == "planar_to_patch";
    for (std::size_t i = 0; i < 4; ++i) {
      const CurvePoint& p = per_term[m].points[i];
      EXPECT_NEAR(p.rmse, std::sqrt(p.epsilon / p.n), 1e-12);
      EXPECT_NEAR(p.rmse_fixed_n, std::sqrt(p.epsilon / per_term[m].points[2].n), 1e-12);
      EXPECT_NEAR(none[m].points[i].epsilon, p.epsilon + (patch ? p.n : 0), 1e-9 * p.epsilon);
      EXPECT_NEAR(total[m].points[i].epsilon, p.epsilon + (patch ? p.n - 1 : 0), 1e-9 * p.epsilon);
    }
  }
  EXPECT_EQ(CurveColumnFromName("rms_residual").value, &CurvePoint::rms_residual);
  EXPECT_THROW(CurveColumnFromName("rsme"), UsageError);
  EXPECT_THROW(PatchOffsetFromName("one"), UsageError);
}

TEST(Curve, IsBitIdenticalForAnyNumberOfThreads) {
  const EveryMetric all;
  const std::vector<Objective>& objectives = all.objectives;
  const Path path(SE3d(), kMotion, PathKind::kLerpSlerp);
  CurveOptions options;
  options.samples = 20;
  const auto one = EvaluateCurves(objectives, path, options);
  options.threads = 3;
  const auto three = EvaluateCurves(objectives, path, options);
  for (std::size_t m = 0; m < one.size(); ++m) {
    for (std::size_t i = 0; i < one[m].points.size(); ++i) {
      EXPECT_EQ(one[m].points[i].rmse, three[m].points[i].rmse);
      EXPECT_EQ(one[m].points[i].slope_analytic, three[m].points[i].slope_analytic);
    }
  }
}

TEST(Curve, RefusesAbsurdGridsAndEmptyMatchings) {
  const ClosestPointMatcher matcher(Room().source, Room().target, {1e-6});
  const std::vector<Objective> objectives = {Objective("point_to_point", matcher)};
  const Path path(SE3d(), kMotion, PathKind::kLerpSlerp);
  EXPECT_THROW(EvaluateCurves(objectives, path, {}), ComputationError);
  CurveOptions options;
  options.threads = 2;
  EXPECT_THROW(EvaluateCurves(objectives, path, options), ComputationError);
  options.samples = 1;
  EXPECT_THROW(EvaluateCurves(objectives, path, options), UsageError);
  options.samples = 10;
  options.u_min = options.u_max;
  EXPECT_THROW(EvaluateCurves(objectives, path, options), UsageError);
  options.u_min = NAN;
  EXPECT_THROW(EvaluateCurves(objectives, path, options), UsageError);
}

// On real scans the plane metrics' minimum lies at the ground truth.
TEST(Curve, RealScansHaveTheirMinimumAtTheGroundTruth) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::filesystem::path root = KittiRoot();
  struct {
    const char* sequence;
    int frame;
    double within_m;
  } const cases[] = {{"00", 15, 0.03}, {"00", 95, 0.03}, {"07", 2, 0.01}};
  for (const auto& c : cases) {
    const ScanSequence sequence = OpenKittiSequence(root, c.sequence);
    ScanPair pair = sequence.Pair(c.frame, c.frame - 1);
    EstimateNormals({}, 2, &pair.source);
    EstimateNormals({}, 2, &pair.target);
    const SE3d truth = *pair.T_ground_truth;
    const ClosestPointMatcher matcher(pair.source, pair.target);
    const std::vector<Objective> objectives = {Objective("point_to_plane", matcher),
                                               Objective("symmetric", matcher)};
    CurveOptions options;
    options.u_min = 17. / 33;  // The default grid's own samples about the minimum.
    options.u_max = 49. / 33;
    options.samples = 33;
    options.threads = 2;
    for (const Curve& curve :
         EvaluateCurves(objectives, Path(SE3d(), truth, PathKind::kLerpSlerp), options)) {
      EXPECT_LT(std::abs(curve.Minimum().u - 1) * truth.t().norm(), c.within_m)
          << curve.metric << " on " << c.sequence << "/" << c.frame;
    }
  }
}

}  // namespace
}  // namespace icpscape
