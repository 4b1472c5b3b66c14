// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/landscape/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/sequences.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/residuals/registry.h"
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

TEST(Curve, GridsHitStartAndReferenceExactly) {
  CurveOptions options;
  EXPECT_EQ(options.samples, 100);
  EXPECT_FALSE(options.frozen_u);
  EXPECT_EQ(options.U(0), -1);
  EXPECT_EQ(options.U(33), 0);
  EXPECT_EQ(options.U(66), 1);
  EXPECT_EQ(options.U(99), 2);
  // Where u_min + i (u_max - u_min) / 10 or 30 would miss by rounding.
  options.u_min = -0.4;
  options.u_max = 1.6;
  options.samples = 11;
  EXPECT_EQ(options.U(7), 1);
  options.u_min = -1.4;
  options.u_max = 2.8;
  options.samples = 31;
  EXPECT_EQ(options.U(10), 0);
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

// The matches of one pose, at another one: neither is u = 1.
TEST(Curve, FrozenMatchesAreThoseOfTheirU) {
  const EveryMetric all;
  const Path path(SE3d(), kMotion, PathKind::kLerpSlerp);
  for (const double frozen_u : {0.25, -0.5}) {
    CurveOptions options;
    options.samples = 4;
    options.frozen_u = frozen_u;
    const auto curves = EvaluateCurves(all.objectives, path, options);
    for (std::size_t m = 0; m < curves.size(); ++m) {
      const Objective& objective = all.objectives[m];
      const Matches matches = objective.Match(path.Pose(frozen_u), 1);
      for (const CurvePoint& p : curves[m].points) {
        const Evaluation expected = objective.Evaluate(path.Pose(p.u), matches, 1);
        EXPECT_DOUBLE_EQ(p.epsilon, expected.epsilon) << curves[m].metric << " at " << p.u;
        EXPECT_EQ(p.n, static_cast<double>(expected.n()));
        EXPECT_DOUBLE_EQ(p.cost, expected.sums.cost);
        EXPECT_DOUBLE_EQ(p.rms_residual, expected.RmsResidual());
        EXPECT_DOUBLE_EQ(p.slope_analytic, expected.RmseSlope(path.BodyTwist(p.u)));
      }
    }
  }
}

// The error of differences of second order falls with the square of the step, also at the ends.
TEST(Curve, NumericSlopesAreOfSecondOrderEverywhere) {
  const EveryMetric all;
  const Path path(SE3d(), kMotion, PathKind::kLerpSlerp);
  CurveOptions options;
  options.frozen_u = 0.3;
  options.u_min = -0.6;
  options.u_max = -0.4;
  options.samples = 5;
  const auto coarse = EvaluateCurves(all.objectives, path, options);
  options.samples = 9;
  const auto fine = EvaluateCurves(all.objectives, path, options);
  const auto error = [](const CurvePoint& p) {
    return std::abs(p.slope_numeric - p.slope_analytic);
  };
  for (std::size_t m = 0; m < coarse.size(); ++m) {
    if (MetricNamed(coarse[m].metric).epsilon != Epsilon::kSquared) {
      continue;  // Sums of roots bend too sharply for steps of this size.
    }
    for (const std::size_t i : {0U, 2U, 4U}) {
      const double falls = error(coarse[m].points[i]) / error(fine[m].points[2 * i]);
      EXPECT_GT(falls, 3.3) << coarse[m].metric << " at " << coarse[m].points[i].u;
      EXPECT_LT(falls, 4.7) << coarse[m].metric << " at " << coarse[m].points[i].u;
    }
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
  EXPECT_EQ(FromName<PatchOffset>("per_term"), PatchOffset::kPerTerm);
  EXPECT_EQ(FromName<PatchOffset>("total"), PatchOffset::kTotal);
  EXPECT_EQ(FromName<PatchOffset>("none"), PatchOffset::kNone);
  EXPECT_EQ(CurveOptions().patch_offset, PatchOffset::kPerTerm);
  EXPECT_THROW(CurveColumnFromName("rsme"), UsageError);
  EXPECT_THROW(FromName<PatchOffset>("one"), UsageError);
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
  const auto check = [](double u_min, double u_max, int samples) {
    CurveOptions grid;
    grid.u_min = u_min;
    grid.u_max = u_max;
    grid.samples = samples;
    grid.Check();
  };
  EXPECT_NO_THROW(check(-1e6, 1e6, 1000000));
  EXPECT_THROW(check(-1.01e6, 1, 10), UsageError);
  EXPECT_THROW(check(-1, 1.01e6, 10), UsageError);
  EXPECT_THROW(check(-1, 1, 1000001), UsageError);
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
