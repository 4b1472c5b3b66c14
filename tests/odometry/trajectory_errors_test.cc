// SPDX-License-Identifier: BSD-3-Clause
// KITTI's errors of stretches, and their means.
#include "icpscape/odometry/trajectory_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/io/trajectory.h"
#include "tests/odometry/trajectories.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

using testing_support::Drive;
using testing_support::Forward;
using testing_support::kDegree;
using testing_support::Perturbed;
using testing_support::WindingDrive;

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
  const std::vector<SegmentError> errors = KittiSegmentErrors({truth, truth, {}});
  ASSERT_GT(errors.size(), 100U);
  for (const SegmentError& error : errors) {
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

// Bins reach 2 m/s to either side, their ends left out: neighbours overlap.
TEST(MeanSegmentErrors, OfASpeedAreThoseOfItsBin) {
  std::vector<SegmentError> errors(3);
  const double speeds_mps[] = {3.9, 4, 5.5};
  for (std::size_t i = 0; i < 3; ++i) {
    errors[i].speed_mps = speeds_mps[i];
    errors[i].translation = std::pow(10, i);
    errors[i].rotation_rad_per_m = 2 * std::pow(10, i);
  }
  EXPECT_EQ(MeanOfSpeed(errors, 2)->segments, 1);
  EXPECT_EQ(MeanOfSpeed(errors, 2)->translation, 1);
  EXPECT_EQ(MeanOfSpeed(errors, 4)->segments, 3);
  EXPECT_DOUBLE_EQ(MeanOfSpeed(errors, 4)->rotation_rad_per_m, 74);
  EXPECT_EQ(MeanOfSpeed(errors, 6)->segments, 1);
  EXPECT_EQ(MeanOfSpeed(errors, 6)->translation, 100);
  EXPECT_FALSE(MeanOfSpeed(errors, 8));
}

}  // namespace
}  // namespace icpscape
