// SPDX-License-Identifier: BSD-3-Clause
// Which steps the minimizer takes: on the room, and on problems of one source point that are made
// so that steps must be refused.
#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/minimizer/minimizer.h"
#include "tests/minimizer/room.h"

namespace icpscape {
namespace {

using testing_support::AddPoint;
using testing_support::BothModes;
using testing_support::DistanceM;
using testing_support::kMotion;

const testing_support::MovedRoom& Room() { return testing_support::RoomOfKMotion(); }

using StepsInBothModes = BothModes;
INSTANTIATE_TEST_SUITE_P(Minimizer, StepsInBothModes, testing_support::EachMode(),
                         testing::PrintToStringParamName());

// Gauss-Newton as one writes it by hand, on the same objective: the same poses, as many matching
// passes, and the same end: a step below the documented limits, a tenth of a millimetre and 1e-5
// rad, is not taken.
TEST(Steps, AreThoseOfGaussNewtonByHand) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  for (const char* metric : {"point_to_plane", "symmetric"}) {
    const Objective objective(metric, matcher);
    std::vector<SE3d> poses;
    SE3d T;
    for (;;) {
      poses.push_back(T);
      const NormalEquations sums = objective.Evaluate(T, 1).sums;
      const SE3d step = SE3d::Exp(-sums.Hessian().ldlt().solve(sums.gradient));
      if (DistanceM(step, SE3d()) < 1e-4 && step.LogRotation().norm() < 1e-5) {
        break;
      }
      T = T * step;
    }
    const MinimizerSummary summary = Minimize(objective, SE3d(), {});
    EXPECT_EQ(summary.termination, Termination::kConverged);
    EXPECT_LE(summary.matching_passes, static_cast<int>(poses.size())) << metric;
    ASSERT_EQ(summary.iterates.size(), poses.size()) << metric;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_LT(DistanceM(poses[i], summary.iterates[i].T_target_source), 1e-6) << metric << i;
    }
  }
}

// The same rooms, told in frames whose origins are far away and turned.
TEST_P(StepsInBothModes, DoNotHangOnTheOrigin) {
  const SE3d T_far_source = SE3d::Exp((Vec6() << 0.4, -0.2, 1.1, 300, -150, 40).finished());
  const SE3d T_far_target = SE3d::Exp((Vec6() << -0.3, 0.5, -2, -90, 220, -60).finished());
  const PointCloud far_source = Room().source.Transformed(T_far_source);
  const PointCloud far_target = Room().target.Transformed(T_far_target);
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const ClosestPointMatcher far_matcher(far_source, far_target);
  const MinimizerSummary summary =
      Minimize(Objective("point_to_plane", matcher), SE3d(), Options());
  const MinimizerSummary far = Minimize(Objective("point_to_plane", far_matcher),
                                        T_far_target * T_far_source.Inverse(), Options());
  EXPECT_EQ(far.termination, summary.termination);
  ASSERT_EQ(far.iterates.size(), summary.iterates.size());
  for (std::size_t i = 0; i < far.iterates.size(); ++i) {
    const Iterate& here = summary.iterates[i];
    const Iterate& there = far.iterates[i];
    EXPECT_NEAR(there.step_m, here.step_m, 1e-4) << i;
    EXPECT_NEAR(there.step_rad, here.step_rad, 1e-5) << i;
    EXPECT_NEAR(there.smallest_eigenvalue, here.smallest_eigenvalue,
                1e-2 * here.smallest_eigenvalue);
    EXPECT_NEAR(there.largest_eigenvalue, here.largest_eigenvalue, 1e-2 * here.largest_eigenvalue);
  }
  EXPECT_LT(DistanceM(T_far_target.Inverse() * far.T_target_source() * T_far_source,
                      summary.T_target_source()),
            1e-4);
}

// Besl and McKay: point-to-point ICP never raises its cost.
TEST(Steps, OfPointToPointDescendMonotonically) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_point", matcher);
  const MinimizerSummary summary = Minimize(objective, SE3d(), {});
  ASSERT_GT(summary.iterates.size(), 5U);
  for (std::size_t i = 1; i < summary.iterates.size(); ++i) {
    EXPECT_LE(summary.iterates[i].cost, summary.iterates[i - 1].cost * (1 + 1e-12));
  }
}

// A point 1 m beside the axis about which it may turn, and a plane x = `plane_m`: at the angle a
// the residual is cos(a) - plane_m, its derivative -sin(a). Near 0 Gauss-Newton's step is far too
// long.
class Turntable {
 public:
  explicit Turntable(double plane, double lever_m = 1) {
    AddPoint(Vec3(lever_m, 0, 0), &source_);
    AddPoint(Vec3(plane * lever_m, 0, 0), &target_);
    target_.nx = {1}, target_.ny = {0}, target_.nz = {0};
  }
  MinimizerSummary Minimized(double start_rad, MinimizerOptions options) const {
    const ClosestPointMatcher matcher(source_, target_);
    options.free = {false, false, true, false, false, false};
    return Minimize(Objective("point_to_plane", matcher), Turned(start_rad), options);
  }
  static SE3d Turned(double angle_rad) { return SE3d::Exp(angle_rad * Vec6::Unit(2)); }
  static double AngleAt(const SE3d& T) { return T.LogRotation().z(); }

 private:
  PointCloud source_, target_;
};

// A plane beyond the circle: at 0.3 rad the step is -(1.5 - cos 0.3) / sin 0.3 = -1.8 rad, which
// raises the cost, until it is a fraction of that.
TEST_P(StepsInBothModes, AreShortenedUntilTheyDescend) {
  MinimizerOptions options = Options();
  options.max_iterations = Mode() == Reassociation::kEveryStep ? 1 : 10;
  const MinimizerSummary summary = Turntable(1.5).Minimized(0.3, options);
  ASSERT_GE(summary.iterates.size(), 2U) << summary.message;
  EXPECT_NEAR(summary.iterates[0].cost, 0.5 * std::pow(1.5 - std::cos(0.3), 2), 1e-9);
  EXPECT_LT(summary.iterates[1].cost, summary.iterates[0].cost);
  EXPECT_LT(std::abs(Turntable::AngleAt(summary.iterates[1].T_target_source)), 0.3);
}

// At 0.01 rad, next to the minimum, the step is -50 rad; the first that descends is a millionth of
// that. It is short because longer ones were refused, which is no convergence.
TEST_P(StepsInBothModes, ThatAreShortAfterRefusalsAreNoConvergence) {
  MinimizerOptions options = Options();
  options.min_step_m = options.min_step_rad = 0.005;
  const MinimizerSummary summary = Turntable(1.5).Minimized(0.01, options);
  EXPECT_EQ(summary.termination, Termination::kNoDescent) << summary.message;
  EXPECT_NEAR(Turntable::AngleAt(summary.T_target_source()), 0.01, 0.005);
}

// A plane that the circle reaches at acos(0.995). The first steps are refused, the last are not:
// this is convergence.
TEST_P(StepsInBothModes, ConvergeAfterRefusalsThatArePast) {
  const MinimizerSummary summary = Turntable(0.995).Minimized(0.005, Options());
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_NEAR(std::abs(Turntable::AngleAt(summary.T_target_source())), std::acos(0.995), 1e-4);
}

// The limits on steps end the loop, and none of Ceres' own tolerances. The lever is so short that
// gradients are below Ceres' 1e-10 before the steps are below 1e-5 rad, and the last step, which is
// found to be short, is below its 1e-8.
TEST_P(StepsInBothModes, GoOnBelowTheTolerancesOfCeres) {
  const MinimizerSummary summary = Turntable(0.995, 1e-3).Minimized(0.2, Options());
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.iterates.back().gradient_norm, 1e-10);
  EXPECT_NEAR(Turntable::AngleAt(summary.T_target_source()), std::acos(0.995), 1e-6);
}

// Without limits the loop ends where the fit is perfect to the last bit: a result, and no failure.
TEST_P(StepsInBothModes, EndAtAPerfectFit) {
  MinimizerOptions options = Options();
  options.min_step_m = options.min_step_rad = 0;
  const MinimizerSummary summary = Turntable(0.995).Minimized(0.2, options);
  EXPECT_TRUE(summary.Usable()) << summary.message;
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_EQ(summary.final_cost(), 0);
  EXPECT_NEAR(Turntable::AngleAt(summary.T_target_source()), std::acos(0.995), 1e-6);
}

// A point on a rail along x, and target points along it, each with a plane: where target point i is
// the closest, the residual is slope_i (x - x_i) + rest_i.
class Rail {
 public:
  Rail() { AddPoint(Vec3::Zero(), &source_); }
  void Add(double x_m, double slope, double rest_m) {
    const Vec3 n(slope, std::sqrt(1 - slope * slope), 0);
    AddPoint(Vec3(x_m, rest_m == 0 ? 0 : -rest_m / n.y(), 0), &target_);
    target_.nx.push_back(static_cast<float>(n.x()));
    target_.ny.push_back(static_cast<float>(n.y()));
    target_.nz.push_back(0);
  }
  MinimizerSummary Minimized(MinimizerOptions options, double gate_m = 0) const {
    const ClosestPointMatcher matcher(source_, target_, {gate_m});
    options.free = {false, false, false, true, false, false};
    return Minimize(Objective("point_to_plane", matcher), SE3d(), options);
  }

 private:
  PointCloud source_, target_;
};

MinimizerOptions EveryEvaluation() {
  MinimizerOptions options;
  options.reassociation = Reassociation::kEveryEvaluation;
  return options;
}

// From x = 0 by residuals of -0.5, 0.2 (at 1 m), 0.4 (at 3 m) and 0 (at 5 m): a hill that is lower
// than the start.
Rail RailOverAHill() {
  Rail rail;
  rail.Add(0, 0.5, -0.5);
  rail.Add(1.2, -0.1, 0.18);
  rail.Add(3, -0.2, 0.4);
  rail.Add(5, 0.9, 0);
  return rail;
}

TEST(NonMonotoneSteps, CrossAHillBelowTheStart) {
  const MinimizerSummary summary = RailOverAHill().Minimized(EveryEvaluation());
  ASSERT_TRUE(summary.Usable()) << summary.message;
  EXPECT_NEAR(summary.T_target_source().t().x(), 5, 1e-4);
  ASSERT_GE(summary.iterates.size(), 4U);
  EXPECT_NEAR(summary.iterates[1].cost, 0.5 * 0.2 * 0.2, 1e-6);
  EXPECT_NEAR(summary.iterates[2].cost, 0.5 * 0.4 * 0.4, 1e-6);
  EXPECT_NEAR(summary.final_cost(), 0, 1e-9);
}

// The same hill with a flat top, from which no step leads on: the result is the pose before it, and
// the observer has seen where the loop went.
TEST(NonMonotoneSteps, ThatLeadNowhereAreCutOff) {
  Rail rail;
  rail.Add(0, 0.5, -0.5);
  rail.Add(1.2, -0.1, 0.18);
  rail.Add(3, 0, 0.4);
  std::vector<double> seen_m;
  MinimizerOptions options = EveryEvaluation();
  options.observer = [&](const Observation& seen) {
    seen_m.push_back(seen.iterate.T_target_source.t().x());
    return true;
  };
  const MinimizerSummary summary = rail.Minimized(options);
  ASSERT_TRUE(summary.Usable()) << summary.message;
  ASSERT_EQ(seen_m.size(), 3U);
  EXPECT_NEAR(seen_m[2], 3, 1e-4);
  EXPECT_EQ(summary.iterates.size(), 2U);
  EXPECT_NEAR(summary.T_target_source().t().x(), 1, 1e-4);
  EXPECT_NEAR(summary.final_cost(), 0.5 * 0.2 * 0.2, 1e-6);
}

// A cost that rises has changed as well: new pairs may raise it, and the loop goes on.
TEST(Steps, ThatRaiseTheCostAreAChange) {
  MinimizerOptions options;
  options.min_cost_change = 0.1;
  const MinimizerSummary summary = RailOverAHill().Minimized(options);
  ASSERT_EQ(summary.iterates.size(), 4U) << summary.message;
  EXPECT_GT(summary.iterates[2].cost, 2 * summary.iterates[1].cost);
  EXPECT_NEAR(summary.T_target_source().t().x(), 5, 1e-4);
}

// The step to x = 1 leaves the gate of 1.45 m about the one target point, which is 1.33 m beside
// the rail, at |x| = 0.57. No pair is no perfect fit.
TEST(Steps, DoNotGoWhereNoPairIsLeft) {
  Rail rail;
  rail.Add(0, 0.8, -0.8);
  const MinimizerSummary summary = rail.Minimized(EveryEvaluation(), 1.45);
  ASSERT_TRUE(summary.Usable()) << summary.message;
  for (const Iterate& iterate : summary.iterates) {
    EXPECT_EQ(iterate.n, 1);
  }
  ASSERT_GE(summary.iterates.size(), 2U);
  EXPECT_GT(summary.T_target_source().t().x(), 0.01);
  EXPECT_LT(summary.T_target_source().t().x(), 0.58);
  EXPECT_GT(summary.final_cost(), 0.5 * std::pow(0.8 * 0.42, 2));
}

}  // namespace
}  // namespace icpscape
