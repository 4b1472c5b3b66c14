// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/consistency.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "icpscape/common/error.h"
#include "tests/support/message_of.h"

namespace icpscape {
namespace {

// Twelve errors: a step to either side along every axis, of length 1 + axis.
std::vector<Vec6> Cross() {
  std::vector<Vec6> errors;
  for (int axis = 0; axis < 6; ++axis) {
    errors.push_back((1 + axis) * Vec6::Unit(axis));
    errors.push_back(-(1 + axis) * Vec6::Unit(axis));
  }
  return errors;
}

TEST(Consistency, StatisticsByHand) {
  const ErrorStatistics statistics = StatisticsOf(Cross());
  EXPECT_EQ(statistics.n, 12);
  EXPECT_LT(statistics.mean.norm(), 1e-15);
  for (int axis = 0; axis < 6; ++axis) {
    const double deviation = (1 + axis) * std::sqrt(2.0 / 11);
    EXPECT_NEAR(statistics.deviation[axis], deviation, 1e-14);
    EXPECT_NEAR(statistics.standard_error[axis], deviation / std::sqrt(12.0), 1e-14);
  }
  EXPECT_NEAR(statistics.covariance(0, 1), 0, 1e-15);
  EXPECT_THROW(StatisticsOf({Vec6::Zero()}), ComputationError);
}

TEST(Consistency, NeesByHand) {
  const std::vector<Vec6> errors = Cross();
  const std::vector<Mat6> unit(errors.size(), Mat6::Identity());
  const double sum = 2 * (1 + 4 + 9 + 16 + 25 + 36);
  EXPECT_NEAR(NeesAboutTruth(errors, unit).mean, sum / 12, 1e-12);
  EXPECT_NEAR(NeesAboutMean(errors, unit).mean, sum / 11, 1e-12);
  const std::vector<Mat6> four(errors.size(), 4 * Mat6::Identity());
  EXPECT_NEAR(NeesAboutTruth(errors, four).Overconfidence(), std::sqrt(sum / 12 / 6) / 2, 1e-12);
  const Vec6 ratio = DeviationRatio(StatisticsOf(errors), four);
  EXPECT_NEAR(ratio[2], 2 / (3 * std::sqrt(2.0 / 11)), 1e-12);
  // Variances are averaged, not deviations: those of 1 and 9 to 5.
  std::vector<Mat6> one_and_nine = unit;
  for (std::size_t i = 0; i < errors.size(); i += 2) {
    one_and_nine[i] *= 9;
  }
  EXPECT_NEAR(DeviationRatio(StatisticsOf(errors), one_and_nine)[2],
              std::sqrt(5.0) / (3 * std::sqrt(2.0 / 11)), 1e-12);
}

TEST(Consistency, RefusesWhatIsNoCovariance) {
  const auto message = [](const std::vector<Mat6>& covariances) {
    return testing_support::MessageOf<UsageError>([&] {
      NeesAboutTruth({Vec6::Ones(), Vec6::Ones()}, covariances);
    });
  };
  Mat6 flat = Mat6::Identity();
  flat(3, 3) = 0;
  EXPECT_EQ(message({Mat6::Identity()}),
            "2 errors and 1 covariances; expected as many of both, at least one.");
  EXPECT_EQ(message({Mat6::Identity(), flat}),
            "Covariance 1 is not positive definite; expected all of them to be.");
}

// Tables of the chi-square distribution: 60 degrees of freedom, 2.5 and 97.5 %.
TEST(Consistency, BoundsAreThoseOfTheTables) {
  std::vector<Vec6> errors(10, Vec6::Ones());
  errors[0] *= 2;
  std::vector<Mat6> unit(10, Mat6::Identity());
  const Nees truth = NeesAboutTruth(errors, unit);
  EXPECT_NEAR(truth.lower, 40.4817 / 10, 1e-4);
  EXPECT_NEAR(truth.upper, 83.2977 / 10, 1e-4);
  errors.push_back(Vec6::Zero());
  unit.push_back(Mat6::Identity());
  const Nees mean = NeesAboutMean(errors, unit);
  EXPECT_NEAR(mean.lower, 40.4817 / 10, 1e-4);
  EXPECT_NEAR(mean.upper, 83.2977 / 10, 1e-4);
}

// Gaussian errors of a known covariance, and a bias.
TEST(Consistency, TellsRightFromWrongCovariancesAndBiasFromSpread) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  Mat6 root = Mat6::Identity();
  root(3, 1) = 2;
  root(5, 0) = -0.5;
  const Mat6 P = root * root.transpose();
  const Vec6 bias = (Vec6() << 0, 0, 0, 3, 0, 0).finished();
  std::vector<Vec6> errors;
  for (int i = 0; i < 200; ++i) {
    Vec6 white;
    for (double& value : white) {
      value = normal(engine);
    }
    errors.push_back(bias + root * white);
  }
  const std::vector<Mat6> right(errors.size(), P);
  EXPECT_TRUE(NeesAboutMean(errors, right).Consistent());
  EXPECT_GT(NeesAboutTruth(errors, right).mean, NeesAboutTruth(errors, right).upper);
  const std::vector<Mat6> small(errors.size(), 0.25 * P);
  EXPECT_GT(NeesAboutMean(errors, small).mean, NeesAboutMean(errors, small).upper);
  EXPECT_NEAR(NeesAboutMean(errors, small).Overconfidence(), 2, 0.2);
  const std::vector<Mat6> large(errors.size(), 4 * P);
  EXPECT_LT(NeesAboutMean(errors, large).mean, NeesAboutMean(errors, large).lower);
  const ErrorStatistics statistics = StatisticsOf(errors);
  EXPECT_NEAR(statistics.mean[3], 3, 4 * statistics.standard_error[3]);
  for (const double ratio : DeviationRatio(statistics, right)) {
    EXPECT_NEAR(ratio, 1, 0.15);
  }
}

}  // namespace
}  // namespace icpscape
