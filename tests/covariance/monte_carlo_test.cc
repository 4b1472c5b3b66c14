// SPDX-License-Identifier: BSD-3-Clause
#include "src/covariance/monte_carlo.h"

#include <gtest/gtest.h>

#include "src/common/error.h"
#include "src/simulation/scenes.h"

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
      for (int e = 0; e < kEstimators; ++e) {
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
  SimulatedPair pair = SimulatePair(options.scene, options.seed, options.lidar, 1);
  EstimateNormals({}, 1, &pair.source);
  EstimateNormals({}, 1, &pair.target);
  const ObjectiveSet set(pair.source, pair.target, {}, options.metrics, options.objective);
  RandomStartOptions start = options.start;
  start.count = 1;
  const MinimizerSummary summary = Minimize(
      set.objectives()[0], RandomStarts(pair.T_target_source, start)[0], PreciseMinimizer());
  const Vec6 error = (pair.T_target_source.Inverse() * summary.T_target_source()).Log();
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
