// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/monte_carlo/monte_carlo.h"

#include <gtest/gtest.h>

#include "icpscape/common/error.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulated_sequence.h"
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
  const MinimizerSummary summary = Minimize(
      set.objectives()[0], RandomStarts(*pair.T_ground_truth, start)[0], PreciseMinimizer());
  const Vec6 error = (pair.T_ground_truth->Inverse() * summary.T_target_source()).Log();
  EXPECT_LT((draw.error - error).norm(), 1e-12);
}

// The first draw is the seed's own sensor either way.
TEST(MonteCarlo, TheSensorIsRedrawnWhereThatIsAsked) {
  MonteCarloOptions options = Small();
  options.draws = 2;
  const auto fixed = RunMonteCarlo(options);
  options.sensor = Sensor::kRedrawn;
  const auto redrawn = RunMonteCarlo(options);
  EXPECT_EQ(fixed[0][0].error, redrawn[0][0].error);
  EXPECT_NE(fixed[0][1].error, redrawn[0][1].error);
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
  draws[2].covariances[0] = Mat6::Identity();
  const Calibration calibration = Calibrate(draws);
  EXPECT_EQ(calibration.failed, 1);
  EXPECT_EQ(calibration.unconverged, 1);
  EXPECT_EQ(calibration.errors.n, 3);
  EXPECT_EQ(calibration.errors.mean, Vec6::Ones());
  // Of the errors 0 and 2 alone: 6 for each, about their mean of 1, over N - 1 = 1.
  EXPECT_EQ(calibration.estimators[0].draws, 2);
  EXPECT_NEAR(calibration.estimators[0].about_mean.mean, 12, 1e-12);
  EXPECT_NEAR(calibration.estimators[0].about_truth.mean, 12, 1e-12);
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
}

}  // namespace
}  // namespace icpscape
