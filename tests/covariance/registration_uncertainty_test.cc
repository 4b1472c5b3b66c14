// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/registration_uncertainty.h"

#include <gtest/gtest.h>

#include "icpscape/cloud/displacement.h"
#include "icpscape/common/error.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.3, 0.05, -0.02).finished());

TEST(RegistrationUncertainty, IsThatOfTheSolution) {
  const testing_support::MovedRoom room(3000, kMotion);
  const ClosestPointMatcher matcher(room.source, room.target);
  const Objective objective("point_to_plane", matcher);
  const CovarianceOptions options;
  const RegistrationUncertainty result = RegisterWithUncertainty(objective, SE3d(), options, 10, 2);
  const SE3d& T = result.registration.T_target_source();
  EXPECT_LT((kMotion.Inverse() * T).t().norm(), 0.01);
  // The covariance is of the size of the actual error, which is not known to the function.
  const Vec6 error = (kMotion.Inverse() * T).Log();
  ASSERT_EQ(result.covariances.size(), AllOf<Estimator>().size());
  const Mat6 gauss_newton = result.covariances[0].covariance.value();
  EXPECT_LT(error.dot(gauss_newton.inverse() * error), 10 * 6);
  EXPECT_GT(gauss_newton(3, 3), 1e-10);
  // Directions are eigenvectors of the Hessian in [L omega; v] about the centroid, L = 10 m: a turn
  // about it moves the origin.
  const Mat6 hessian = objective.Evaluate(T, 1).sums.Hessian();
  Mat6 motions = Mat6::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 omega = Vec3::Unit(axis) / 10;
    motions.col(axis) << omega, -omega.cross(CentroidOf(room.source));
  }
  const Vec6 weakest = result.directions.directions.col(0);
  const Vec6 product = motions.transpose() * hessian * motions * weakest;
  EXPECT_LT((product - result.directions.eigenvalues[0] * weakest).norm(), 1e-9 * product.norm());
  EXPECT_EQ(result.judgements.size(), 4U * 6U);
  for (const EstimatedCovariance& entry : result.covariances) {
    EXPECT_EQ(entry.covariance.has_value(), entry.reason.empty());
  }
  EXPECT_EQ(
      result.covariances[2].reason,
      "the clouds carry no ring numbers (those of KITTI's scans are recovered for edges and planar "
      "points alone)");
}

// The same rooms in frames whose origins, but not the sensors, are elsewhere. The covariances are
// of the motion of the frame's origin: they are compared about the sensor.
TEST(RegistrationUncertainty, DoesNotHangOnTheOrigin) {
  const testing_support::MovedRoom room(3000, kMotion);
  const SE3d source_shift(Mat3::Identity(), Vec3(300, -150, 40));
  const SE3d target_shift(Mat3::Identity(), Vec3(-90, 220, -60));
  const auto found = [](const PointCloud& source, const PointCloud& target, const SE3d& T_start) {
    const ClosestPointMatcher matcher(source, target);
    return RegisterWithUncertainty(Objective("point_to_plane", matcher), T_start, {}, 10, 2);
  };
  const RegistrationUncertainty here = found(room.source, room.target, SE3d());
  const RegistrationUncertainty far =
      found(room.source.Transformed(source_shift), room.target.Transformed(target_shift),
            target_shift * source_shift.Inverse());
  EXPECT_LT((far.directions.eigenvalues - here.directions.eigenvalues).norm(),
            1e-3 * here.directions.eigenvalues[5]);
  ASSERT_EQ(far.judgements.size(), here.judgements.size());
  for (std::size_t i = 0; i < far.judgements.size(); ++i) {
    EXPECT_NEAR(far.judgements[i].value, here.judgements[i].value, 0.01 * here.judgements[i].value)
        << here.judgements[i].rule << i;
  }
  const Mat6 about_sensor = AboutPoint(source_shift.t(), 1);
  for (std::size_t i = 0; i < far.covariances.size(); ++i) {
    if (!here.covariances[i].covariance) {
      continue;
    }
    const Mat6& covariance = *here.covariances[i].covariance;
    const Mat6 of_far =
        about_sensor * far.covariances[i].covariance.value() * about_sensor.transpose();
    EXPECT_LT((of_far - covariance).norm(), 0.05 * covariance.norm()) << i;
  }
}

TEST(RegistrationUncertainty, SaysWhyThereIsNone) {
  PointCloud plane;
  for (int i = 0; i < 400; ++i) {
    testing_support::AddPoint(Vec3(0.3 * (i % 20) - 3, 0.3 * (i / 20) - 3, -1.7), &plane);
  }
  EstimateNormals({}, 1, &plane);
  const ClosestPointMatcher matcher(plane, plane);
  const RegistrationUncertainty result =
      RegisterWithUncertainty(Objective("point_to_plane", matcher), SE3d(), {}, 10, 1);
  for (const EstimatedCovariance& entry : result.covariances) {
    EXPECT_FALSE(entry.covariance.has_value());
    EXPECT_EQ(entry.reason, "the pairs do not determine all six degrees of freedom");
  }
}

TEST(RegistrationUncertainty, NeedsARegistration) {
  const testing_support::MovedRoom room(500, kMotion);
  MatchingOptions none;
  none.max_distance_m = 1e-9;
  const ClosestPointMatcher matcher(room.source, room.target, none);
  EXPECT_THROW(RegisterWithUncertainty(Objective("point_to_plane", matcher), SE3d(), {}, 10, 1),
               ComputationError);
}

}  // namespace
}  // namespace icpscape
