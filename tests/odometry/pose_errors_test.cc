// SPDX-License-Identifier: BSD-3-Clause
// Errors of single poses, and which poses are compared.
#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/common/error.h"
#include "icpscape/odometry/trajectory_errors.h"
#include "tests/odometry/trajectories.h"
#include "tests/support/message_of.h"

namespace icpscape {
namespace {

using testing_support::Drive;
using testing_support::Forward;
using testing_support::kDegree;
using testing_support::Perturbed;
using testing_support::WindingDrive;
using testing_support::Yaw;

// By hand: a square of 1 m; the estimate is the truth, moved by 1 m in y and turned by 90 degrees.
TEST(AbsoluteErrors, AlignmentsByHand) {
  const std::vector<SE3d> truth = Drive(Forward(1) * Yaw(90 * kDegree), 4);
  TrajectoryPair pair = {truth, truth, {}};
  const SE3d moved = SE3d(Yaw(90 * kDegree).R(), Vec3(0, 1, 0));
  for (SE3d& T : pair.estimate) {
    T = moved * T;
  }
  // Positions (0,0) (1,0) (1,1) (0,1) become (0,1) (0,2) (-1,2) (-1,1).
  const PoseErrors given = AbsoluteErrors(pair, *AlignmentOf(pair, Alignment::kNone));
  const double expected[] = {1, std::sqrt(5), std::sqrt(5), 1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(given.translation_m[i], expected[i], 1e-12);
    EXPECT_NEAR(given.rotation_rad[i], 90 * kDegree, 1e-12);
  }
  for (const Alignment alignment : {Alignment::kFirstPose, Alignment::kRigid}) {
    const SE3d T = *AlignmentOf(pair, alignment);
    EXPECT_LE((T.Matrix() - moved.Inverse().Matrix()).norm(), 1e-12);
    EXPECT_LE(Summarize(AbsoluteErrors(pair, T).translation_m).max, 1e-12);
    EXPECT_LE(Summarize(AbsoluteErrors(pair, T).rotation_rad).max, 1e-12);
  }
}

// No small motion of the best alignment makes the sum of squares smaller.
TEST(AbsoluteErrors, RigidAlignmentIsTheBest) {
  const std::vector<SE3d> truth = WindingDrive(500);
  const TrajectoryPair pair = {truth, Perturbed(truth, 3), {}};
  const SE3d T = *AlignmentOf(pair, Alignment::kRigid);
  const auto rmse = [&](const SE3d& T_truth_estimate) {
    return Summarize(AbsoluteErrors(pair, T_truth_estimate).translation_m).rmse;
  };
  EXPECT_LT(rmse(T), rmse(*AlignmentOf(pair, Alignment::kFirstPose)));
  for (int k = 0; k < 6; ++k) {
    for (const double step : {-1e-4, 1e-4}) {
      Vec6 xi = Vec6::Zero();
      xi(k) = step;
      EXPECT_GT(rmse(T * SE3d::Exp(xi)), rmse(T));
    }
  }
}

TEST(AbsoluteErrors, NoRigidAlignmentOnALine) {
  const TrajectoryPair pair = {Drive(Forward(1), 50), Drive(Forward(1.1), 50), {}};
  EXPECT_FALSE(AlignmentOf(pair, Alignment::kRigid));
  // One of the two is enough, whichever it is.
  const std::vector<SE3d> winding = WindingDrive(static_cast<int>(pair.truth.size()));
  EXPECT_TRUE(AlignmentOf({winding, winding, {}}, Alignment::kRigid));
  EXPECT_FALSE(AlignmentOf({winding, pair.estimate, {}}, Alignment::kRigid));
  EXPECT_FALSE(AlignmentOf({pair.truth, winding, {}}, Alignment::kRigid));
  EXPECT_TRUE(AlignmentOf(pair, Alignment::kFirstPose));
}

// A line is one to a hundredth of its length. A zigzag over 49 m has a deviation of 14.43 m along
// it, and one of its amplitude across.
TEST(AbsoluteErrors, ALineIsOneToAHundredth) {
  const auto has_alignment = [](double amplitude_m) {
    std::vector<SE3d> zigzag = Drive(Forward(1), 50);
    for (std::size_t i = 0; i < zigzag.size(); ++i) {
      const double side = i % 4 == 0 || i % 4 == 3 ? amplitude_m : -amplitude_m;
      zigzag[i] = SE3d(Mat3::Identity(), zigzag[i].t() + Vec3(0, side, 0));
    }
    return AlignmentOf({zigzag, zigzag, {}}, Alignment::kRigid).has_value();
  };
  EXPECT_FALSE(has_alignment(0.14));
  EXPECT_TRUE(has_alignment(0.15));
}

// Straight on by 1 m; the estimate turns by 1 degree on the spot before every step of 1.1 m.
TEST(RelativeErrors, ByHand) {
  const TrajectoryPair pair = {Drive(Forward(1), 5), Drive(Yaw(kDegree) * Forward(1.1), 5), {}};
  const PoseErrors one = RelativeErrors(pair, 1);
  ASSERT_EQ(one.translation_m.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(one.translation_m[i],
                std::hypot(1.1 * std::cos(kDegree) - 1, 1.1 * std::sin(kDegree)), 1e-12);
    EXPECT_NEAR(one.rotation_rad[i], kDegree, 1e-12);
  }
  const PoseErrors two = RelativeErrors(pair, 2);
  ASSERT_EQ(two.translation_m.size(), 3U);
  const double x = 1.1 * (std::cos(kDegree) + std::cos(2 * kDegree));
  const double y = 1.1 * (std::sin(kDegree) + std::sin(2 * kDegree));
  EXPECT_NEAR(two.translation_m[0], std::hypot(x - 2, y), 1e-12);
  EXPECT_NEAR(two.rotation_rad[2], 2 * kDegree, 1e-12);
  EXPECT_TRUE(RelativeErrors(pair, 5).translation_m.empty());
  EXPECT_EQ(testing_support::MessageOf<UsageError>([&] { RelativeErrors(pair, 0); }),
            "Relative errors over 0 frames; expected at least 1.");
}

TEST(Statistics, ByHand) {
  const Statistics odd = Summarize({3, 1, 2});
  EXPECT_DOUBLE_EQ(odd.rmse, std::sqrt(14.0 / 3));
  EXPECT_DOUBLE_EQ(odd.mean, 2);
  EXPECT_DOUBLE_EQ(odd.median, 2);
  EXPECT_DOUBLE_EQ(odd.max, 3);
  EXPECT_EQ(testing_support::MessageOf<UsageError>([] { Summarize({}); }),
            "Statistics of no values; expected at least one.");
  const Statistics even = Summarize({4, 1, 2, 10});
  EXPECT_DOUBLE_EQ(even.rmse, std::sqrt(121.0 / 4));
  EXPECT_DOUBLE_EQ(even.mean, 17.0 / 4);
  EXPECT_DOUBLE_EQ(even.median, 3);
  EXPECT_DOUBLE_EQ(even.max, 10);
}

Trajectory AtTimes(const std::vector<double>& times_s) {
  Trajectory trajectory;
  for (const double time : times_s) {
    trajectory.times_s.push_back(time);
    trajectory.T_world_body.push_back(Forward(time));  // The pose tells which one it is.
  }
  return trajectory;
}

TEST(Associate, ByTimeOneToOne) {
  const Trajectory truth = AtTimes({0, 0.1, 0.2, 0.3, 0.4});
  // 0.104 and 0.099 both are nearest to 0.1: the nearer stays. 0.25 is too far from either side.
  const Trajectory estimate = AtTimes({0.099, 0.104, 0.25, 0.301, 9});
  const TrajectoryPair pair = Associate(truth, estimate, 0.01);
  ASSERT_EQ(pair.truth.size(), 2U);
  EXPECT_EQ(pair.truth[0].t().x(), 0.1);
  EXPECT_EQ(pair.estimate[0].t().x(), 0.099);
  EXPECT_EQ(pair.truth[1].t().x(), 0.3);
  EXPECT_EQ(pair.estimate[1].t().x(), 0.301);
  EXPECT_EQ(pair.times_s, (std::vector<double>{0.1, 0.3}));
  EXPECT_THROW(Associate(truth, AtTimes({7, 8, 9}), 0.01), InputError);
}

TEST(Associate, ByTimesThatAreNearEnough) {
  const Trajectory truth = AtTimes({0, 1, 2});
  EXPECT_EQ(Associate(truth, AtTimes({0.009, 1.011, 1.991}), 0.01).times_s,
            (std::vector<double>{0, 2}));
  EXPECT_EQ(Associate(truth, AtTimes({0.009, 1.011, 1.991}), 0.02).times_s,
            (std::vector<double>{0, 1, 2}));
}

TEST(Associate, ByIndexWhereATimeIsMissing) {
  Trajectory truth = AtTimes({0, 1, 2});
  truth.times_s.clear();
  const TrajectoryPair pair = Associate(truth, AtTimes({5, 6, 7}), 0.01);
  EXPECT_EQ(pair.estimate[2].t().x(), 7);
  EXPECT_EQ(pair.times_s, (std::vector<double>{5, 6, 7}));
  EXPECT_THROW(Associate(truth, AtTimes({5, 6}), 0.01), InputError);
}

}  // namespace
}  // namespace icpscape
