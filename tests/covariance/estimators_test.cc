// SPDX-License-Identifier: BSD-3-Clause
// The estimators over given sums: what each makes of them, and where there is no covariance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/covariance/covariance.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::StartsWith;
using testing_support::MessageOf;

// Sums that have every covariance: all matrices are the identity.
CovarianceSums Sound() {
  CovarianceSums sums;
  for (Mat6* matrix : {&sums.gauss_newton, &sums.hessian, &sums.rematched_hessian, &sums.scores,
                       &sums.cluster_scores, &sums.range_noise}) {
    *matrix = Mat6::Identity();
  }
  sums.ring_bias = Mat6::Identity();
  sums.cost = 1;
  sums.rows = 100;
  return sums;
}

bool Has(Estimator estimator, const CovarianceSums& sums) {
  return EstimateCovariance(estimator, sums, CovarianceOptions()).has_value();
}

// H = 4 I, cost 3, eight rows for six unknowns: s^2 = 2 * 3 / 2, and the covariance s^2 / 4 I.
TEST(Estimators, GaussNewtonNeedsARowToSpareAndAResidual) {
  CovarianceSums sums = Sound();
  sums.gauss_newton *= 4;
  sums.cost = 3;
  sums.rows = 8;
  const auto covariance = EstimateCovariance(Estimator::kGaussNewton, sums, {});
  ASSERT_TRUE(covariance);
  EXPECT_LE((*covariance - 0.75 * Mat6::Identity()).norm(), 1e-14);
  sums.rows = 7;
  EXPECT_NEAR((*EstimateCovariance(Estimator::kGaussNewton, sums, {}))(2, 2), 1.5, 1e-14);
  for (const long too_few : {6L, 5L, 0L}) {
    sums.rows = too_few;
    EXPECT_FALSE(Has(Estimator::kGaussNewton, sums)) << too_few;
  }
  sums.rows = 8;
  sums.cost = 0;  // A perfect fit says nothing about the noise.
  EXPECT_FALSE(Has(Estimator::kGaussNewton, sums));
}

// By hand: A = 2 I, so that A^-1 M A^-1 = M / 4.
TEST(Estimators, ScaleTheirNoise) {
  CovarianceSums sums = Sound();
  sums.hessian *= 2;
  sums.ring_bias = 3 * Mat6::Identity();
  sums.scores *= 5;
  CovarianceOptions options;
  options.range_noise_m = 0.1;
  options.ring_bias_m = 0.3;
  const auto diagonal = [&](Estimator estimator) {
    return (*EstimateCovariance(estimator, sums, options))(4, 4);
  };
  EXPECT_NEAR(diagonal(Estimator::kCensi), 0.01 / 4, 1e-15);
  EXPECT_NEAR(diagonal(Estimator::kCensiRingBias), (0.01 + 0.09 * 3) / 4, 1e-15);
  EXPECT_NEAR(diagonal(Estimator::kSandwich), 5.0 / 4, 1e-14);
}

// Singular is an eigenvalue below 1e-12 of the largest, with rotations scaled to the size of
// translations: at a lever arm of 1000 m theirs are a million times as large, and do not count.
// (The check that the scale is a number has no test: without it the bound refuses the same
// matrices.)
TEST(Estimators, HaveNoneWhereAnEigenvalueIsBelowTheBound) {
  for (const double lever_m : {1.0, 1000.0}) {
    CovarianceSums sums = Sound();
    sums.gauss_newton.topLeftCorner<3, 3>() *= lever_m * lever_m;
    sums.gauss_newton(5, 5) = 1.1e-12;
    EXPECT_TRUE(Has(Estimator::kGaussNewton, sums)) << lever_m;
    sums.gauss_newton(5, 5) = 0.9e-12;
    for (const Estimator estimator : AllOf<Estimator>()) {
      EXPECT_FALSE(Has(estimator, sums)) << lever_m << " " << NameOf(estimator);
    }
  }
}

TEST(Estimators, HaveNoneWhereTheBreadIsNoMinimums) {
  CovarianceSums sums = Sound();
  sums.hessian(1, 1) = sums.rematched_hessian(1, 1) = -1;
  EXPECT_TRUE(Has(Estimator::kGaussNewton, sums));
  for (const Estimator estimator : AllOf<Estimator>()) {
    EXPECT_EQ(Has(estimator, sums), estimator == Estimator::kGaussNewton);
  }
}

// Five independent sums do not fill six dimensions.
TEST(Estimators, HaveNoneWhereTheNoiseLeavesADirectionOut) {
  CovarianceSums sums = Sound();
  for (Mat6* matrix : {&sums.scores, &sums.cluster_scores, &sums.range_noise}) {
    (*matrix)(3, 3) = 0;
  }
  for (const Estimator estimator : AllOf<Estimator>()) {
    // A constant error of a ring fills what single ranges leave out.
    EXPECT_EQ(Has(estimator, sums),
              estimator == Estimator::kGaussNewton || estimator == Estimator::kCensiRingBias);
  }
  sums.ring_bias = std::nullopt;
  EXPECT_FALSE(Has(Estimator::kCensiRingBias, sums));
}

TEST(Estimators, HaveNoneOfUndeterminedProblems) {
  // A plane, and three matches (nine rows of point-to-point, but point-to-plane has three).
  PointCloud plane;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      testing_support::AddPoint(Vec3(0.3 * i - 3, 0.3 * j - 3, -1.7), &plane);
    }
  }
  EstimateNormals({}, 1, &plane);
  const ClosestPointMatcher matcher(plane, plane);
  const Objective objective("point_to_plane", matcher);
  const SE3d T(Mat3::Identity(), Vec3(0.01, 0, 0.02));
  const CovarianceSums sums = SumForCovariance(objective, T, {}, 1);
  PointCloud three;
  testing_support::AddPoint(Vec3(1, 0, -1.7), &three);
  testing_support::AddPoint(Vec3(0, 1, -1.7), &three);
  testing_support::AddPoint(Vec3(2, 1, -1.7), &three);
  const ClosestPointMatcher few_matcher(three, plane);
  const Objective few("point_to_plane", few_matcher);
  const CovarianceSums few_sums = SumForCovariance(few, T, {}, 1);
  EXPECT_EQ(few_sums.rows, 3);
  for (const Estimator estimator : AllOf<Estimator>()) {
    EXPECT_FALSE(EstimateCovariance(estimator, sums, CovarianceOptions()));
    EXPECT_FALSE(EstimateCovariance(estimator, few_sums, CovarianceOptions()));
    EXPECT_FALSE(EstimateCovariance(estimator, CovarianceSums(), CovarianceOptions()));
  }
  EXPECT_FALSE(sums.ring_bias);
}

// B is not symmetric. By hand, with B = I + E_01 / 2 and so B^-1 = I - E_01 / 2:
// B^-1 diag(1, 4, 1, 1, 1, 1) B^-T has 1 + 4 / 4, -4 / 2 and 4 in its corner.
TEST(Estimators, TurnTheBreadOfTheRematchedSandwichTheRightWay) {
  CovarianceSums sums;
  sums.gauss_newton = Mat6::Identity();
  sums.rematched_hessian = Mat6::Identity();
  sums.rematched_hessian(0, 1) = 0.5;
  sums.cluster_scores = Mat6::Identity();
  sums.cluster_scores(1, 1) = 4;
  Mat6 expected = Mat6::Identity();
  expected.topLeftCorner<2, 2>() << 2, -2, -2, 4;
  const auto covariance = EstimateCovariance(Estimator::kSandwichRematched, sums, {});
  ASSERT_TRUE(covariance);
  EXPECT_LE((*covariance - expected).norm(), 1e-14);
}

TEST(Estimators, WarnWherePairsFollowThePose) {
  EXPECT_NE(CovarianceWarning("point_to_point"), "");
  EXPECT_EQ(CovarianceWarning("point_to_plane"), "");
}

TEST(CovarianceOptions, RefuseWhatIsOutOfRange) {
  const double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](double CovarianceOptions::*member, double value) {
    CovarianceOptions options;
    options.*member = value;
    return MessageOf<UsageError>([&] { options.Check(); });
  };
  struct Range {
    double CovarianceOptions::*member;
    const char* begins;
    double low, high;
  };
  for (const Range& range :
       {Range{&CovarianceOptions::range_noise_m, "range_noise_m=", 0, 10},
        Range{&CovarianceOptions::ring_bias_m, "ring_bias_m=", 0, 10},
        Range{&CovarianceOptions::cluster_m, "cluster_m=", 0.01, 1000},
        Range{&CovarianceOptions::rematching_step_m, "rematching_step_m=", 1e-4, 1}}) {
    for (const double good : {range.low, range.high}) {
      EXPECT_EQ(message(range.member, good), "nothing was thrown") << range.begins << good;
    }
    for (const double bad : {0.99 * range.low - 1e-9, 1.01 * range.high, kNan}) {
      EXPECT_THAT(message(range.member, bad), StartsWith(range.begins)) << bad;
    }
  }
}

}  // namespace
}  // namespace icpscape
