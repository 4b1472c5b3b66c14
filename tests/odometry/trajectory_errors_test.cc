// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/trajectory_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "icpscape/common/error.h"
#include "icpscape/io/trajectory.h"
#include "tests/support/message_of.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

constexpr double kDegree = M_PI / 180;

SE3d Yaw(double angle_rad) { return SE3d::Exp((Vec6() << 0, 0, angle_rad, 0, 0, 0).finished()); }
SE3d Forward(double length_m) { return SE3d(Mat3::Identity(), Vec3(length_m, 0, 0)); }

// `count` poses, each the one before moved by `motion`.
std::vector<SE3d> Drive(const SE3d& motion, int count) {
  std::vector<SE3d> poses = {SE3d()};
  while (static_cast<int>(poses.size()) < count) {
    poses.push_back(poses.back() * motion);
  }
  return poses;
}

// A long drive with curves, slopes and all speeds up to 20 m/s.
std::vector<SE3d> WindingDrive(int count) {
  std::vector<SE3d> poses = {SE3d()};
  for (int i = 1; i < count; ++i) {
    const double s = i / 400.0;
    Vec6 twist;
    twist << 0.002 * std::sin(7 * s), 0.003 * std::cos(5 * s), 0.02 * std::sin(3 * s),
        1 + std::sin(2 * s), 0, 0;
    poses.push_back(poses.back() * SE3d::Exp(twist));
  }
  return poses;
}

// An odometry that errs at random in every step.
std::vector<SE3d> Perturbed(const std::vector<SE3d>& truth, unsigned seed) {
  std::mt19937 engine(seed);
  const auto noise = [&] { return static_cast<double>(engine()) / 2147483648.0 - 1; };
  std::vector<SE3d> poses = {truth[0]};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    Vec6 xi;
    for (int k = 0; k < 6; ++k) {
      xi(k) = (k < 3 ? 1e-3 : 2e-2) * noise();
    }
    poses.push_back(poses.back() * (truth[i - 1].Inverse() * truth[i]) * SE3d::Exp(xi));
  }
  return poses;
}

// By hand: 1 m a frame straight on, 102 frames. Path lengths are 0 to 101 m, so that from frame 0
// 100 m are exceeded at frame 101, and from frame 10 never. The estimate goes 1.01 m a frame.
TEST(KittiSegmentErrors, SmallCaseByHand) {
  const auto errors = KittiSegmentErrors({Drive(Forward(1), 102), Drive(Forward(1.01), 102), {}});
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].first_frame, 0);
  EXPECT_EQ(errors[0].last_frame, 101);
  EXPECT_EQ(errors[0].length_m, 100);
  // 101 m of motion against 102.01 m, over a nominal 100 m.
  EXPECT_NEAR(errors[0].translation, 1.01 / 100, 1e-12);
  EXPECT_NEAR(errors[0].rotation_rad_per_m, 0, 1e-12);
  // 102 frames of 0.1 s count; with times it is what lies between the first and the last.
  EXPECT_NEAR(errors[0].speed_mps, 100 / 10.2, 1e-12);
  std::vector<double> times_s;
  for (int i = 0; i < 102; ++i) {
    times_s.push_back(5 + 0.2 * i);
  }
  const auto timed =
      KittiSegmentErrors({Drive(Forward(1), 102), Drive(Forward(1.01), 102), times_s});
  EXPECT_NEAR(timed[0].speed_mps, 100 / 20.2, 1e-12);
}

TEST(KittiSegmentErrors, LastFrameLiesFartherThanTheLength) {
  // A path of exactly 100 m has no such frame.
  EXPECT_TRUE(KittiSegmentErrors({Drive(Forward(1), 101), Drive(Forward(1), 101), {}}).empty());
  // 901 m in steps of 1 m: a stretch of 100 m ends 101 m after its first frame.
  int expected = 0;
  for (int first = 0; first < 902; first += 10) {
    for (int length = 100; length <= 800; length += 100) {
      expected += first + length + 1 <= 901 ? 1 : 0;
    }
  }
  const std::vector<SE3d> drive = Drive(Forward(1), 902);
  EXPECT_EQ(KittiSegmentErrors({drive, drive, {}}).size(), static_cast<std::size_t>(expected));
}

TEST(KittiSegmentErrors, TruthHasNone) {
  const std::vector<SE3d> truth = WindingDrive(3000);
  for (const SegmentError& error : KittiSegmentErrors({truth, truth, {}})) {
    EXPECT_LE(error.translation, 1e-12);
    EXPECT_LE(error.rotation_rad_per_m, 1e-12);
  }
}

TEST(KittiSegmentErrors, DoNotDependOnTheWorldFrames) {
  const std::vector<SE3d> truth = WindingDrive(2000);
  TrajectoryPair pair = {truth, Perturbed(truth, 1), {}};
  const auto given = KittiSegmentErrors(pair);
  for (SE3d& T : pair.estimate) {
    T = SE3d::Exp((Vec6() << 1, -2, 0.5, 100, 20, 3).finished()) * T;
  }
  const auto moved = KittiSegmentErrors(pair);
  ASSERT_EQ(given.size(), moved.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_NEAR(moved[i].translation, given[i].translation, 1e-12);
    EXPECT_NEAR(moved[i].rotation_rad_per_m, given[i].rotation_rad_per_m, 1e-12);
  }
}

// A scale of 1.01 stretches the chord of each segment; on a straight drive chord and path agree but
// for the last step beyond the nominal length: at 0.01 m a frame, 1 % to 1e-6.
TEST(KittiSegmentErrors, ScaleErrorOnAStraightDrive) {
  const auto mean =
      MeanOf(KittiSegmentErrors({Drive(Forward(0.01), 20000), Drive(Forward(0.0101), 20000), {}}));
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->translation, 0.01, 1e-6);
  EXPECT_NEAR(mean->rotation_rad_per_m, 0, 1e-12);
}

// 0.02 degrees a metre too much to the left: an arc instead of a line. At length L the heading is
// off by k L, and the end by |2 sin(k L / 2) / k - L, ...|, about k L^2 / 2.
TEST(KittiSegmentErrors, ConstantYawDrift) {
  const double k = 0.02 * kDegree;
  const SE3d step = SE3d::Exp((Vec6() << 0, 0, 0.1 * k, 0.1, 0, 0).finished());
  const auto errors = KittiSegmentErrors({Drive(Forward(0.1), 4000), Drive(step, 4000), {}});
  for (const double length : {100.0, 200.0, 300.0}) {
    const auto mean = MeanOfLength(errors, length);
    ASSERT_TRUE(mean);
    EXPECT_NEAR(mean->rotation_rad_per_m, k, 0.002 * k);  // The last step goes beyond the length.
    const double x = std::sin(k * length) / k, y = (1 - std::cos(k * length)) / k;
    EXPECT_NEAR(mean->translation, std::hypot(length - x, y) / length, 0.003 * k * length);
  }
  EXPECT_FALSE(MeanOfLength(errors, 400));
}

// The second method: plain loops over matrices and angles by acos, as the protocol is worded.
struct Reference {
  std::vector<double> translation, rotation, speed, length;
};
Reference ByMatrices(const std::vector<SE3d>& truth, const std::vector<SE3d>& estimate) {
  Reference result;
  const int n = static_cast<int>(truth.size());
  const auto at = [](const std::vector<SE3d>& poses, int i) {
    return poses[static_cast<std::size_t>(i)].Matrix();
  };
  for (int first = 0; first < n; first += 10) {
    for (int length = 100; length <= 800; length += 100) {
      double path = 0;
      int last = first;
      while (path <= length && ++last < n) {
        path += (at(truth, last) - at(truth, last - 1)).col(3).norm();
      }
      if (last >= n) {
        continue;
      }
      const Eigen::Matrix4d delta_truth = at(truth, first).inverse() * at(truth, last);
      const Eigen::Matrix4d delta = at(estimate, first).inverse() * at(estimate, last);
      const Eigen::Matrix4d error = delta.inverse() * delta_truth;
      const double cosine = (error.trace() - 2) / 2;
      result.translation.push_back(error.col(3).head<3>().norm() / length);
      result.rotation.push_back(std::acos(std::min(1.0, std::max(-1.0, cosine))) / length);
      result.speed.push_back(length / (0.1 * (last - first + 1)));
      result.length.push_back(length);
    }
  }
  return result;
}

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

void ExpectAgreesWithTheSecondMethod(const std::vector<SE3d>& truth) {
  const std::vector<SE3d> estimate = Perturbed(truth, 7);
  const auto errors = KittiSegmentErrors({truth, estimate, {}});
  const Reference reference = ByMatrices(truth, estimate);
  ASSERT_GT(errors.size(), 100U);
  ASSERT_EQ(errors.size(), reference.length.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_EQ(errors[i].length_m, reference.length[i]);
    EXPECT_NEAR(errors[i].speed_mps, reference.speed[i], 1e-12);
    EXPECT_NEAR(errors[i].translation, reference.translation[i], 1e-10);
    EXPECT_NEAR(errors[i].rotation_rad_per_m, reference.rotation[i], 1e-9);
  }
  const auto mean = MeanOf(errors);
  EXPECT_NEAR(mean->translation, Mean(reference.translation), 1e-10);
  EXPECT_NEAR(mean->rotation_rad_per_m, Mean(reference.rotation), 1e-9);
  EXPECT_GT(mean->translation, 1e-3);  // There was something to measure.
  for (const double speed : kKittiSpeedsMps) {
    std::vector<double> binned;
    for (std::size_t i = 0; i < reference.speed.size(); ++i) {
      if (reference.speed[i] > speed - 2 && reference.speed[i] < speed + 2) {
        binned.push_back(reference.translation[i]);
      }
    }
    const auto of_speed = MeanOfSpeed(errors, speed);
    ASSERT_EQ(of_speed.has_value(), !binned.empty());
    if (of_speed) {
      EXPECT_EQ(of_speed->segments, static_cast<int>(binned.size()));
      EXPECT_NEAR(of_speed->translation, Mean(binned), 1e-10);
    }
  }
}

TEST(KittiSegmentErrors, AgreesWithTheSecondMethodOnALongDrive) {
  ExpectAgreesWithTheSecondMethod(WindingDrive(3000));
}

TEST(KittiSegmentErrors, AgreesWithTheSecondMethodOnKitti) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  for (const char* sequence : {"00", "07"}) {
    ExpectAgreesWithTheSecondMethod(
        ReadTrajectory(KittiFiles(KittiRoot(), sequence).Poses()).T_world_body);
  }
}

TEST(MeanSegmentErrors, OfSequencesAndOfSegments) {
  // Three segments of 1 % and one of 5 %: 2 % by segments, 3 % by sequences.
  SegmentError one, five;
  one.translation = 0.01;
  five.translation = 0.05;
  five.rotation_rad_per_m = 0.4;
  EXPECT_NEAR(MeanOf({one, one, one, five})->translation, 0.02, 1e-15);
  EXPECT_NEAR(MeanOf({one, one, one, five})->rotation_rad_per_m, 0.1, 1e-15);
  const auto mean = MeanOfMeans({*MeanOf({one, one, one}), *MeanOf({five})});
  EXPECT_NEAR(mean->translation, 0.03, 1e-15);
  EXPECT_NEAR(mean->rotation_rad_per_m, 0.2, 1e-15);
  EXPECT_EQ(mean->segments, 4);
  EXPECT_FALSE(MeanOf({}));
  EXPECT_FALSE(MeanOfMeans({}));
}

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
  EXPECT_DOUBLE_EQ(Summarize({4, 1, 2, 10}).median, 3);
  EXPECT_EQ(testing_support::MessageOf<UsageError>([] { Summarize({}); }),
            "Statistics of no values; expected at least one.");
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
