// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/monte_carlo/monte_carlo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/common/error.h"
#include "icpscape/objective/loss.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulated_sequence.h"
#include "icpscape/simulation/simulator.h"
#include "tests/support/message_of.h"
#include "tests/support/prepared.h"

namespace icpscape {
namespace {

MonteCarloOptions Small() {
  MonteCarloOptions options;
  options.lidar.azimuth_step_deg = 2;
  options.draws = 3;
  options.start.minimizer = PreciseMinimizer();
  options.threads = 2;
  return options;
}

TEST(MonteCarlo, IsTheSameForAnyNumberOfThreads) {
  MonteCarloOptions options = Small();
  options.metrics = {"point_to_plane", "edge_to_line"};
  const auto two = RunMonteCarlo(options);
  options.threads = 1;
  int last = 0;
  const auto one = RunMonteCarlo(options, [&](int done) { last = done; });
  EXPECT_EQ(last, options.draws);
  ASSERT_EQ(one.size(), 2U);
  for (std::size_t m = 0; m < one.size(); ++m) {
    ASSERT_EQ(one[m].size(), 3U);
    for (std::size_t i = 0; i < one[m].size(); ++i) {
      EXPECT_TRUE(one[m][i].usable);
      EXPECT_EQ(one[m][i].error, two[m][i].error);
      for (std::size_t e = 0; e < AllOf<Estimator>().size(); ++e) {
        ASSERT_TRUE(one[m][i].covariances[static_cast<std::size_t>(e)]);
        EXPECT_EQ(*one[m][i].covariances[static_cast<std::size_t>(e)],
                  *two[m][i].covariances[static_cast<std::size_t>(e)]);
      }
    }
  }
}

// Draw 0 is the pair that every other program simulates, from its own start.
TEST(MonteCarlo, FirstDrawIsThePairOfTheSeed) {
  const MonteCarloOptions options = Small();
  const DrawResult draw = RunMonteCarlo(options)[0][0];
  ScanPair pair = SimulatePair(options.scene, options.seed, options.lidar, 1);
  EstimateNormals({}, 1, &pair.source);
  EstimateNormals({}, 1, &pair.target);
  const ObjectiveSet set(testing_support::AsPrepared(pair.source, pair.target), options.metrics,
                         options.objective);
  RandomStartOptions start = options.start;
  start.count = 1;
  const MinimizerSummary summary =
      Minimize(set.objectives()[0], RandomStarts(*pair.T_ground_truth, Vec3::Zero(), start)[0],
               PreciseMinimizer());
  const Vec6 error = (pair.T_ground_truth->Inverse() * summary.T_target_source()).Log();
  EXPECT_LT((draw.error - error).norm(), 1e-12);
}

// Every draw over again from its parts, with no option at its default: another world, lidar, seed,
// loss, neighbourhood, choice of features, start and noise assumed. Scans number themselves on from
// draw to draw, so that no two share their noise.
TEST(MonteCarlo, DrawsAreTheChainOfTheirParts) {
  MonteCarloOptions options = Small();
  options.scene = "highway_overtaking";  // Things move: it matters when a scan is taken.
  options.seed = 3;
  options.lidar.range_noise_m = 0.02;
  options.metrics = {"symmetric", "edge_to_line"};  // Both normals, and features.
  options.preparation.normals.num_neighbors = 9;
  options.preparation.features.edge_from = 0.2;
  options.preparation.features.planar_below = 0.2;
  options.objective.loss = MakeLoss("huber", 0.05);
  options.start.translation_m = 0.1;
  options.start.rotation_rad = 0.01;
  options.covariance = {0.05, 0.07, 0.5, 0.03};
  const Scene scene = MakeScene("highway_overtaking", 3);
  const Simulator simulator(scene.world, options.lidar, 3);
  RandomStartOptions start = options.start;
  start.count = 3;
  start.seed = 3;
  const std::vector<SE3d> starts = RandomStarts(scene.T_target_source(), Vec3::Zero(), start);
  for (const Sensor sensor : {Sensor::kFixed, Sensor::kRedrawn}) {
    options.sensor = sensor;
    const auto results = RunMonteCarlo(options);
    for (std::size_t draw = 0; draw < 3; ++draw) {
      const std::uint64_t copy = sensor == Sensor::kRedrawn ? draw : 0;
      const int before = 2 * static_cast<int>(draw);
      PointCloud target = simulator.Scan(scene.T_world_lidar[1], 0, before + 1, 1, copy);
      PointCloud source = simulator.Scan(scene.T_world_lidar[2], 0.1, before + 2, 1, copy);
      EstimateNormals({9, 0}, 1, &target);
      EstimateNormals({9, 0}, 1, &source);
      const Features features = ExtractFeatures(source, options.preparation.features, 1);
      const ObjectiveSet set(testing_support::AsPrepared(source, target, features), options.metrics,
                             options.objective);
      for (std::size_t m = 0; m < 2; ++m) {
        const Objective& objective = set.objectives()[m];
        const MinimizerSummary summary = Minimize(objective, starts[draw], PreciseMinimizer());
        const SE3d& T = summary.T_target_source();
        const DrawResult& result = results[m][draw];
        EXPECT_EQ(result.termination, summary.termination);
        EXPECT_EQ(result.iterations, static_cast<int>(summary.iterates.size()) - 1);
        EXPECT_LT(
            (SE3d::Exp(result.error).Matrix() - (scene.T_target_source().Inverse() * T).Matrix())
                .norm(),
            1e-12);
        const CovarianceSums sums = SumForCovariance(objective, T, options.covariance, 1);
        for (const Estimator estimator : AllOf<Estimator>()) {
          const auto expected = EstimateCovariance(estimator, sums, options.covariance);
          const auto& actual = result.covariances[static_cast<std::size_t>(estimator)];
          ASSERT_EQ(actual.has_value(), expected.has_value()) << NameOf(estimator);
          if (expected) {
            EXPECT_EQ(*actual, *expected) << NameOf(estimator);
          }
        }
      }
    }
  }
}

// From one start, and with one sensor, draws differ by the noise of their scans alone: by
// millimetres, where the stop rule leaves a hundredth of one.
TEST(MonteCarlo, DrawsDoNotShareTheirNoise) {
  MonteCarloOptions options = Small();
  options.draws = 4;
  options.start.translation_m = options.start.rotation_rad = 0;
  const auto draws = RunMonteCarlo(options)[0];
  for (std::size_t i = 0; i < draws.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT((draws[i].error - draws[k].error).tail<3>().norm(), 5e-4) << i << " " << k;
    }
  }
}

// The noise that is assumed is the simulated lidar's own, and the stop rule is what it says: 10
// micrometres and 0.06 millidegrees.
TEST(MonteCarlo, AssumesTheSimulatedLidarAndStopsLate) {
  EXPECT_EQ(CovarianceOptions().range_noise_m, LidarOptions().range_noise_m);
  EXPECT_EQ(CovarianceOptions().ring_bias_m, LidarOptions().ring_bias_m);
  EXPECT_EQ(PreciseMinimizer().min_step_m, 1e-5);
  EXPECT_GT(PreciseMinimizer().max_iterations, MinimizerOptions().max_iterations);
  EXPECT_NEAR(PreciseMinimizer().min_step_rad * 180 / M_PI, 0.06e-3, 0.005e-3);
}

// On the straight street, at an eighth of the points: what docs/covariance.md says about all of
// them. Ideal is 6.
TEST(MonteCarlo, ClusteredSandwichesAreWithinAFactorOfTwoAndTheOthersAreOverConfident) {
  MonteCarloOptions options = Small();
  options.lidar.azimuth_step_deg = 1.44;
  options.sensor = Sensor::kRedrawn;
  options.draws = 24;
  const Calibration calibration = Calibrate(RunMonteCarlo(options)[0]);
  EXPECT_EQ(calibration.failed, 0);
  EXPECT_LT(calibration.unconverged, 24 / 4);  // Not for want of iterations.
  EXPECT_EQ(calibration.errors.n, 24);
  ASSERT_EQ(calibration.estimators.size(), AllOf<Estimator>().size());
  const auto nees = [&](Estimator estimator) {
    const EstimatorCalibration& entry = calibration.estimators[static_cast<std::size_t>(estimator)];
    EXPECT_EQ(entry.draws, 24);
    // About the truth there is bias as well.
    EXPECT_GT(entry.about_truth.mean, entry.about_mean.mean);
    return entry.about_mean.mean;
  };
  for (const Estimator estimator : {Estimator::kSandwichClustered, Estimator::kSandwichRematched}) {
    EXPECT_GT(nees(estimator), 3) << NameOf(estimator);
    EXPECT_LT(nees(estimator), 12) << NameOf(estimator);
  }
  EXPECT_GT(nees(Estimator::kGaussNewton), 24);
  EXPECT_GT(nees(Estimator::kCensi), 6000);
  EXPECT_GT(nees(Estimator::kCensiRingBias), 600);
}

TEST(MonteCarlo, ADrawWithoutAResultIsLeftOut) {
  std::vector<DrawResult> draws(4);
  for (std::size_t i = 0; i < 3; ++i) {
    draws[i].usable = true;
    draws[i].error = static_cast<double>(i) * Vec6::Ones();
  }
  draws[1].termination = Termination::kMaxIterations;
  draws[0].covariances[0] = Mat6::Identity();
  draws[2].covariances[0] = 4 * Mat6::Identity();
  const Calibration calibration = Calibrate(draws);
  EXPECT_EQ(calibration.failed, 1);
  EXPECT_EQ(calibration.unconverged, 1);
  EXPECT_EQ(calibration.errors.n, 3);
  EXPECT_EQ(calibration.errors.mean, Vec6::Ones());
  // Of the errors 0 and 2 alone, with variances of 1 and 4: 6 and 6 / 4 about their mean of 1, over
  // N - 1 = 1; and 0 and 6 * 4 / 4 about the truth, over N = 2. Their deviation is sqrt(2).
  const EstimatorCalibration& two = calibration.estimators[0];
  EXPECT_EQ(two.draws, 2);
  EXPECT_NEAR(two.about_mean.mean, 7.5, 1e-12);
  EXPECT_NEAR(two.about_truth.mean, 3, 1e-12);
  EXPECT_NEAR(two.deviation_ratio[5], std::sqrt(2.5 / 2), 1e-12);
  EXPECT_LE((two.mean_covariance - 2.5 * Mat6::Identity()).norm(), 1e-12);
  EXPECT_EQ(calibration.estimators[1].draws, 0);
  EXPECT_THROW(Calibrate(std::vector<DrawResult>(5)), ComputationError);
}

TEST(MonteCarlo, RefusesWhatHasNoAnswer) {
  MonteCarloOptions options = Small();
  options.draws = 1;
  EXPECT_THROW(RunMonteCarlo(options), UsageError);
  options = Small();
  options.scene = "nowhere";
  EXPECT_THROW(RunMonteCarlo(options), UsageError);
  options = Small();
  options.covariance.cluster_m = 0;
  EXPECT_THAT(testing_support::MessageOf<UsageError>([&] { RunMonteCarlo(options); }),
              testing::StartsWith("cluster_m=0:"));
}

}  // namespace
}  // namespace icpscape
