// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/random_starts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/objective/loss.h"
#include "icpscape/objective/source_centroid.h"
#include "tests/minimizer/room.h"

namespace icpscape {
namespace {

// Of an objective, which must outlive it.
std::vector<StartResult> RunStarts(const Objective& objective, const SE3d& T_reference,
                                   const RandomStartOptions& options,
                                   const std::function<void(int)>& progress = nullptr) {
  const JointObjective joint(objective);
  return RunRandomStarts([&](const SE3d& T_start,
                             const MinimizerOptions& how) { return Minimize(joint, T_start, how); },
                         T_reference, SourceCentroid(joint), options, progress);
}

using testing_support::AngleRad;
using testing_support::DistanceM;
using testing_support::kMotion;

const testing_support::MovedRoom& Room() { return testing_support::RoomOfKMotion(); }

// Vectors whose direction is uniform on the sphere and whose length is uniform up to `longest`:
// means of 0, mean squares of longest^2 / 9 (a third of that of the length) along every axis, and a
// mean length of half the longest. `count` draws are off by some 1 / sqrt(count).
void ExpectUniformInDirectionAndLength(const std::vector<Vec3>& vectors, double longest) {
  const auto n = static_cast<double>(vectors.size());
  Vec3 mean = Vec3::Zero();
  Vec3 mean_square = Vec3::Zero();
  double mean_length = 0, largest = 0;
  for (const Vec3& v : vectors) {
    mean += v / n;
    mean_square += v.cwiseAbs2() / n;
    mean_length += v.norm() / n;
    largest = std::max(largest, v.norm());
  }
  EXPECT_LE(largest, longest * (1 + 1e-9));
  EXPECT_GE(largest, longest * 0.99);
  EXPECT_NEAR(mean_length, 0.5 * longest, 0.02 * longest);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean[axis], 0, 0.03 * longest) << axis;
    EXPECT_NEAR(mean_square[axis], longest * longest / 9, 0.01 * longest * longest) << axis;
  }
}

const Vec3 kAbout(4, -7, 2);

// The point about which the starts turn is where omega and v are uniform: there T_reference^-1 T is
// Exp([omega; v]). The reference is turned and far away, so that the order matters.
TEST(RandomStarts, AreUniformAboutTheReferenceAndRepeat) {
  RandomStartOptions options;
  options.count = 4000;
  options.translation_m = 0.5;
  options.rotation_rad = 0.05;
  const SE3d reference = SE3d::Exp((Vec6() << 0.2, -0.4, 1, 30, -20, 5).finished());
  const std::vector<SE3d> starts = RandomStarts(reference, kAbout, options);
  ASSERT_EQ(starts.size(), 4000U);
  std::vector<Vec3> rotations, translations;
  for (const SE3d& start : starts) {
    const SE3d to(Mat3::Identity(), kAbout);
    const Vec6 xi = (to.Inverse() * reference.Inverse() * start * to).Log();
    rotations.push_back(xi.head<3>());
    translations.push_back(xi.tail<3>());
  }
  ExpectUniformInDirectionAndLength(rotations, 0.05);
  ExpectUniformInDirectionAndLength(translations, 0.5);
  EXPECT_EQ(starts[7].Matrix(), RandomStarts(reference, kAbout, options)[7].Matrix());
  options.seed = 2;
  EXPECT_NE(starts[7].Matrix(), RandomStarts(reference, kAbout, options)[7].Matrix());
}

TEST(RandomStarts, StayWithinTheFreeDirections) {
  RandomStartOptions options;
  options.minimizer.free = kPlanarDof;
  const SE3d reference = kMotion;
  for (const SE3d& start : RandomStarts(reference, kAbout, options)) {
    const Vec6 xi = (reference.Inverse() * start).Log();
    EXPECT_NEAR(xi.head<2>().norm() + std::abs(xi[5]), 0, 1e-12);
    EXPECT_GT(xi.segment<3>(2).norm(), 0);
  }
}

// What Minimize gives from every start, one after the other.
TEST(RandomStarts, ReportWhatBecameOfEachStart) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  RandomStartOptions options;
  options.count = 4;
  options.minimizer.max_iterations = 2;  // Too few for the far ones.
  options.minimizer.threads = 2;
  options.translation_m = 5;
  const SE3d reference = kMotion * SE3d::Exp((Vec6() << 0, 0, 0.01, 0.02, 0, 0).finished());
  std::vector<int> progress;
  const std::vector<StartResult> results =
      RunStarts(objective, reference, options, [&](int done) { progress.push_back(done); });
  EXPECT_EQ(progress, (std::vector<int>{1, 2, 3, 4}));
  const std::vector<SE3d> starts = RandomStarts(reference, CentroidOf(Room().source), options);
  ASSERT_EQ(results.size(), starts.size());
  int far = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const MinimizerSummary summary = Minimize(objective, starts[i], options.minimizer);
    EXPECT_NEAR(results[i].start_m, DistanceM(reference, starts[i]), 1e-12);
    EXPECT_NEAR(results[i].start_rad, AngleRad(reference, starts[i]), 1e-12);
    EXPECT_NEAR(results[i].end_m, DistanceM(reference, summary.T_target_source()), 1e-12);
    EXPECT_NEAR(results[i].end_rad, AngleRad(reference, summary.T_target_source()), 1e-12);
    EXPECT_EQ(results[i].iterations, 2);
    EXPECT_EQ(results[i].termination, Termination::kMaxIterations);
    if (results[i].start_m > 2) {
      EXPECT_FALSE(results[i].success);
      ++far;
    }
  }
  EXPECT_GT(far, 0);
}

TEST(RandomStarts, SucceedInARoom) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  RandomStartOptions options;
  options.count = 20;
  options.minimizer.threads = 2;
  const std::vector<StartResult> results = RunStarts(objective, kMotion, options);
  ASSERT_EQ(results.size(), 20U);
  for (const StartResult& result : results) {
    EXPECT_TRUE(result.success);
    EXPECT_GT(result.start_m, 0);
    EXPECT_LT(result.end_m, 0.05);
  }
}

// All end at the motion, within millimetres; the reference is off by one kind of error alone.
// Success is within 5 cm and within a quarter of a degree.
TEST(RandomStarts, SucceedWithinMetresAndRadiansBoth) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective objective("point_to_plane", matcher);
  RandomStartOptions options;
  options.count = 2;
  options.minimizer.threads = 2;
  const auto succeed = [&](double off_m, double off_deg) {
    const SE3d reference =
        kMotion * SE3d::Exp((Vec6() << 0, 0, off_deg * M_PI / 180, off_m, 0, 0).finished());
    const std::vector<StartResult> results = RunStarts(objective, reference, options);
    EXPECT_EQ(results[0].success, results[1].success);
    return results[0].success;
  };
  EXPECT_TRUE(succeed(0.04, 0));
  EXPECT_FALSE(succeed(0.06, 0));
  EXPECT_TRUE(succeed(0, 0.2));
  EXPECT_FALSE(succeed(0, 0.3));
}

// A start next to the reference that cannot be minimised is no success.
TEST(RandomStarts, FailWithoutAUsableResult) {
  const ClosestPointMatcher matcher(Room().source, Room().target);
  const Objective flat("point_to_point", matcher, MakeLoss("tukey", 1e-6));
  RandomStartOptions options;
  options.count = 2;
  options.translation_m = 0.01;
  options.rotation_rad = 0.001;
  for (const StartResult& result : RunStarts(flat, kMotion, options)) {
    EXPECT_EQ(result.termination, Termination::kFailure);
    EXPECT_LT(result.end_m, 0.05);
    EXPECT_FALSE(result.success);
  }
  const ClosestPointMatcher gated(Room().source, Room().target, {1e-9});
  for (const StartResult& result :
       RunStarts(Objective("point_to_plane", gated), kMotion, options)) {
    EXPECT_EQ(result.termination, Termination::kNoCorrespondences);
    EXPECT_TRUE(std::isnan(result.end_m) && std::isnan(result.end_rad));
    EXPECT_FALSE(result.success);
  }
}

}  // namespace
}  // namespace icpscape
