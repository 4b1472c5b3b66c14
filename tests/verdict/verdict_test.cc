// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/verdict/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "icpscape/cloud/normals.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;
using testing_support::AddPoint;

struct Pair {
  PointCloud source, target;
};

// Points of a surface, which takes two numbers from 0 to 1, with 5 mm of noise.
template <class Surface>
PointCloud Sampled(int points, unsigned seed, const SE3d& T, const Surface& surface) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> noise(0, 0.005);
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const Vec3 p = surface(i, unit(engine), unit(engine));
    AddPoint(T * (p + Vec3(noise(engine), noise(engine), noise(engine))), &cloud);
  }
  EstimateNormals({}, 2, &cloud);
  return cloud;
}

Vec3 OnPlane(int /*i*/, double a, double b) { return {20 * a - 10, 20 * b - 10, -1.7}; }

// 30 m long, 4 m wide, 3 m high, without ends.
Vec3 InCorridor(int i, double a, double b) {
  const double x = 30 * a - 15;
  switch (i % 4) {
    case 0:
      return {x, -2, 3 * b - 1.7};
    case 1:
      return {x, 2, 3 * b - 1.7};
    case 2:
      return {x, 4 * b - 2, -1.7};
    default:
      return {x, 4 * b - 2, 1.3};
  }
}

template <class Surface>
Pair PairOf(const Surface& surface, const SE3d& T_sensor = SE3d()) {
  return {Sampled(6000, 1, T_sensor, surface), Sampled(6000, 2, T_sensor, surface)};
}

Verdict Judged(const Pair& pair, VerdictOptions options = {}, const SE3d& T_start = SE3d(),
               const char* metric = "point_to_plane") {
  const ClosestPointMatcher matcher(pair.source, pair.target);
  const Objective objective(metric, matcher);
  options.minimizer.threads = 2;
  return JudgePose(objective, Minimize(objective, T_start, options.minimizer), options);
}

TEST(Verdict, ARoomIsDetermined) {
  const testing_support::MovedRoom room(8000, SE3d(Mat3::Identity(), Vec3(0.2, 0.1, 0)));
  const Verdict verdict = Judged({room.source, room.target});
  EXPECT_TRUE(verdict.Determined());
  EXPECT_TRUE(verdict.converged);
  EXPECT_EQ(verdict.pairs, 8000);
  EXPECT_EQ(verdict.matched_share, 1);
  EXPECT_EQ(verdict.Text(), "determined, converged, 100 % of the points took part");
  EXPECT_EQ(verdict.Unobservable().cols(), 0);
}

// Over rooms of other points the errors of the pose have the deviations that were predicted, within
// a factor that 40 draws and the estimator's own bias explain.
TEST(Verdict, PredictsTheSpreadOfPoses) {
  Vec6 squared_error = Vec6::Zero();
  Vec6 predicted = Vec6::Zero();
  constexpr unsigned kDraws = 40;
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    Pair pair = {testing_support::Room(3000, 2 * draw, SE3d(), 0.02),
                 testing_support::Room(3000, 2 * draw + 1, SE3d(), 0.02)};
    EstimateNormals({}, 2, &pair.target);
    const ClosestPointMatcher matcher(pair.source, pair.target);
    const Objective objective("point_to_plane", matcher);
    const MinimizerSummary summary = Minimize(objective, SE3d(), {});
    const Verdict verdict = JudgePose(objective, summary, {});
    ASSERT_TRUE(verdict.Determined());
    squared_error += summary.T_target_source().Log().cwiseAbs2() / kDraws;
    predicted += verdict.deviation.cwiseAbs2() / kDraws;
  }
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    const double ratio = std::sqrt(squared_error[axis] / predicted[axis]);
    EXPECT_GT(ratio, 0.4) << axis;
    EXPECT_LT(ratio, 2.5) << axis;
  }
}

TEST(Verdict, APlaneLeavesThreeDirectionsFree) {
  const Verdict verdict = Judged(PairOf(&OnPlane));
  EXPECT_FALSE(verdict.Determined());
  EXPECT_THAT(verdict.UndeterminedNames(), ElementsAre("yaw", "along x", "along y"));
  EXPECT_TRUE(verdict.HasPose());
  for (const Eigen::Index axis : {2, 3, 4}) {
    EXPECT_TRUE(std::isnan(verdict.deviation[axis])) << axis;
  }
  for (const Eigen::Index axis : {0, 1, 5}) {
    EXPECT_LT(verdict.deviation[axis], 1e-3) << axis;
  }
}

TEST(Verdict, ACorridorIsFreeAlongItself) {
  EXPECT_THAT(Judged(PairOf(&InCorridor)).UndeterminedNames(), ElementsAre("along x"));
  const SE3d quarter = SE3d::Exp((Vec6() << 0, 0, M_PI / 2, 0, 0, 0).finished());
  EXPECT_THAT(Judged(PairOf(&InCorridor, quarter)).UndeterminedNames(), ElementsAre("along y"));
  const SE3d eighth = SE3d::Exp((Vec6() << 0, 0, M_PI / 4, 0, 0, 0).finished());
  EXPECT_THAT(Judged(PairOf(&InCorridor, eighth)).UndeterminedNames(),
              ElementsAre(HasSubstr("along (0.7")));
}

// A laser that scans a plane: all normals are upright, and motion in the plane changes nothing.
TEST(Verdict, APlanarLaserDoesNotSeeItsPlane) {
  PointCloud scan;
  for (int i = 0; i < 2000; ++i) {
    const double angle = 2 * M_PI * i / 2000;
    AddPoint({5 * std::cos(angle), 3 * std::sin(angle), 0}, &scan);
  }
  EstimateNormals({}, 1, &scan);
  const Verdict all = Judged({scan, scan});
  EXPECT_THAT(all.UndeterminedNames(), UnorderedElementsAre("yaw", "along x", "along y"));
  for (const UndeterminedDirection& one : all.undetermined) {
    EXPECT_EQ(one.cause, Cause::kNotObserved);
  }
  EXPECT_EQ(all.Unobservable().cols(), 3);
  VerdictOptions planar;
  planar.minimizer.free = kPlanarDof;
  const Verdict in_plane = Judged({scan, scan}, planar);
  EXPECT_THAT(in_plane.UndeterminedNames(), UnorderedElementsAre("yaw", "along x", "along y"));
  EXPECT_EQ(in_plane.deviation[5], 0);  // Not free.
}

TEST(Verdict, FewerRowsThanDirectionsAreNoPose) {
  const testing_support::MovedRoom room(8000, SE3d());
  std::vector<char> keep(room.source.size());
  for (std::size_t i = 0; i < 5; ++i) {
    keep[i] = 1;
  }
  const Verdict five = Judged({room.source.Select(keep), room.target});
  EXPECT_FALSE(five.HasPose());
  EXPECT_EQ(five.no_pose,
            "5 residual rows for 6 free directions; expected more rows than directions.");
  EXPECT_EQ(five.Text(), "no pose: " + five.no_pose);
  // Point-to-point has three rows to a pair.
  EXPECT_TRUE(
      Judged({room.source.Select(keep), room.target}, {}, SE3d(), "point_to_point").HasPose());
  keep[5] = 1;  // As many as directions: they fit whatever the truth is.
  const Verdict six = Judged({room.source.Select(keep), room.target});
  EXPECT_TRUE(six.HasPose());
  EXPECT_EQ(six.undetermined.size(), 6U);
}

// Points in one place: they see where they are, and no rotation.
TEST(Verdict, PointsInOnePlaceSeeNoRotation) {
  PointCloud cloud;
  for (int i = 0; i < 8; ++i) {
    AddPoint({1, 2, 3}, &cloud);
  }
  const Verdict verdict = Judged({cloud, cloud}, {}, SE3d(), "point_to_point");
  EXPECT_THAT(verdict.UndeterminedNames(), ElementsAre("roll", "pitch", "yaw"));
  EXPECT_EQ(verdict.deviation.tail<3>(), Vec3::Zero());
}

TEST(Verdict, APerfectFitIsDeterminedAndConverged) {
  const testing_support::MovedRoom room(4000, SE3d());
  const Verdict verdict = Judged({room.target, room.target});
  EXPECT_TRUE(verdict.Determined());
  EXPECT_TRUE(verdict.converged);
  EXPECT_EQ(verdict.deviation, Vec6::Zero());
}

TEST(Verdict, TolerancesDecideWhereNothingElseDoes) {
  const testing_support::MovedRoom room(8000, SE3d());
  VerdictOptions options;
  const Verdict healthy = Judged({room.source, room.target}, options);
  const Vec6& sd = healthy.deviation;
  options.tolerance_m = 0.5 * sd.tail<3>().minCoeff();
  const Verdict shifts = Judged({room.source, room.target}, options);
  EXPECT_THAT(shifts.UndeterminedNames(), ElementsAre("along x", "along y", "along z"));
  EXPECT_EQ(shifts.undetermined[0].cause, Cause::kBeyondTolerance);
  EXPECT_EQ(shifts.Unobservable().cols(), 0);
  EXPECT_EQ(shifts.deviation[2], sd[2]);
  options.tolerance_m = 2 * sd.tail<3>().maxCoeff();
  EXPECT_TRUE(Judged({room.source, room.target}, options).Determined());
  options = VerdictOptions();
  options.tolerance_rad = 0.5 * sd.head<3>().minCoeff();
  EXPECT_THAT(Judged({room.source, room.target}, options).UndeterminedNames(),
              ElementsAre("roll", "pitch", "yaw"));
}

// Deviations are about the centroid: far from the origin of the coordinates they stay what they
// are.
TEST(Verdict, DoesNotHangOnTheOrigin) {
  const testing_support::MovedRoom room(8000, SE3d());
  const SE3d away(Mat3::Identity(), Vec3(300, -400, 10));
  const Verdict here = Judged({room.source, room.target});
  const Verdict there = Judged({room.source.Transformed(away), room.target.Transformed(away)});
  EXPECT_TRUE(there.Determined());
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    EXPECT_NEAR(there.deviation[axis], here.deviation[axis], 0.2 * here.deviation[axis]) << axis;
  }
}

// About a centroid 2 m ahead: what is free is a turn about z there, whatever it is elsewhere.
TEST(Verdict, TakesThePredictionWhereNothingIsSeen) {
  Verdict verdict;
  verdict.to_centroid(4, 2) = 2;  // v + omega x c, c = (2, 0, 0).
  verdict.to_centroid(5, 1) = -2;
  verdict.undetermined = {{{Vec6::Unit(2), "yaw"}, Cause::kNoCurvature},
                          {{Vec6::Unit(3), "along x"}, Cause::kBeyondTolerance}};
  const SE3d predicted = SE3d::Exp((Vec6() << 0, 0, 0.1, 0, 0, 0).finished());
  const Vec3 centroid(2, 0, 0);
  const SE3d found = SE3d(Mat3::Identity(), Vec3(0.03, 0.2, 0.01));
  const SE3d taken = verdict.WithPrediction(found, predicted);
  // To first order: the angle is the predicted one, the centroid lies where it was found.
  EXPECT_LE((taken.R() - predicted.R()).norm(), 1e-12);
  EXPECT_LE((taken * centroid - found * centroid).norm(), 0.02);
  EXPECT_GT((predicted * centroid - found * centroid).norm(), 0.03);
  verdict.undetermined.erase(verdict.undetermined.begin());  // Uncertain alone: as it was found.
  EXPECT_EQ(verdict.WithPrediction(found, predicted).t(), found.t());
}

// Poses that go back and forth by less than a tenth of the tolerance are one pose.
TEST(Verdict, ASmallLimitCycleIsConvergence) {
  const testing_support::MovedRoom room(4000, SE3d());
  const ClosestPointMatcher matcher(room.source, room.target);
  const Objective objective("point_to_plane", matcher);
  MinimizerSummary summary = Minimize(objective, SE3d(), {});
  summary.termination = Termination::kLimitCycle;
  const auto converged = [&](double cycle_m, double cycle_rad) {
    summary.cycle_m = cycle_m;
    summary.cycle_rad = cycle_rad;
    return JudgePose(objective, summary, {}).converged;
  };
  EXPECT_TRUE(converged(4e-3, 4e-4));  // Tolerances of 0.05 m and 0.0052 rad.
  EXPECT_FALSE(converged(6e-3, 4e-4));
  EXPECT_FALSE(converged(4e-3, 6e-4));
}

TEST(Verdict, SaysWhereTheStepsEnded) {
  const testing_support::MovedRoom room(4000, SE3d(Mat3::Identity(), Vec3(0.4, 0, 0)));
  VerdictOptions options;
  options.minimizer.max_iterations = 2;
  const Verdict verdict = Judged({room.source, room.target}, options);
  EXPECT_TRUE(verdict.Determined());
  EXPECT_FALSE(verdict.converged);
  EXPECT_THAT(verdict.Text(), HasSubstr("not converged (max_iterations)"));
}

}  // namespace
}  // namespace icpscape
