// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/manifold_test_utils.h>
#include <gtest/gtest.h>

#include "icpscape/residuals/adapters/ceres.h"
#include "icpscape/residuals/point_to_point.h"
#include "icpscape/testing/residual_sampler.h"

namespace icpscape {
namespace {

using namespace ceres;  // NOLINT: the macro below is not qualified in Ceres 2.1.

TEST(SE3Manifold, HoldsCeresInvariants) {
  const SE3Manifold manifold;
  ResidualSampler sampler(42);
  for (int i = 0; i < 1000; ++i) {
    Vector x(7), y(7), delta(6);
    sampler.Pose(3, sampler.Uniform(0, 3)).ToParameters(x.data());
    sampler.Pose(3, sampler.Uniform(0, 3)).ToParameters(y.data());
    if (x.head<4>().dot(y.head<4>()) < 0) {
      y.head<4>() = -y.head<4>();  // The same pose; Plus stays on x's side of the sphere.
    }
    delta << sampler.Uniform(0, 3) * sampler.UnitVector(), sampler.Point(2);
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
  }
}

TEST(SE3Manifold, PlusIsTheExponentialFromTheRight) {
  const SE3Manifold manifold;
  ResidualSampler sampler(1);
  for (int i = 0; i < 100; ++i) {
    const SE3d T = sampler.Pose(3, 1);
    Vec6 xi;
    xi << sampler.UnitVector(), sampler.Point(2);
    double x[7], moved[7];
    T.ToParameters(x);
    ASSERT_TRUE(manifold.Plus(x, xi.data(), moved));
    EXPECT_LE((SE3d::FromParameters(moved).Matrix() - (T * SE3d::Exp(xi)).Matrix()).norm(), 1e-13);
  }
}

TEST(SE3SubsetManifold, HoldsCeresInvariants) {
  ResidualSampler sampler(43);
  for (const DofMask& mask : {kAllDof, kPlanarDof, DofMask{false, true, false, true, false, true},
                              DofMask{false, false, false, false, false, true}}) {
    const SE3SubsetManifold manifold(mask);
    for (int i = 0; i < 250; ++i) {
      const int size = manifold.TangentSize();
      Vector x(7), y(7), delta(size), to_y(size);
      sampler.Pose(3, sampler.Uniform(0, 3)).ToParameters(x.data());
      for (int k = 0; k < size; ++k) {
        delta[k] = sampler.Uniform(-1, 1);
        to_y[k] = sampler.Uniform(-1, 1);
      }
      manifold.Plus(x.data(), to_y.data(), y.data());
      EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
    }
  }
}

TEST(SE3SubsetManifold, StepsInTheFreeDirections) {
  ResidualSampler sampler(2);
  const SE3d T = sampler.Pose(3, 1);
  double x[7], moved[7];
  T.ToParameters(x);
  const double delta[3] = {0.2, 1.5, -0.3};
  SE3SubsetManifold(kPlanarDof).Plus(x, delta, moved);
  const SE3d step = T.Inverse() * SE3d::FromParameters(moved);
  EXPECT_NEAR(step.t().z(), 0, 1e-14);
  EXPECT_LE((step.LogRotation() - Vec3(0, 0, 0.2)).norm(), 1e-14);
  // Along the arc, not the chord: the true exponential.
  EXPECT_LE((step.t() - SE3d::Exp((Vec6() << 0, 0, 0.2, 1.5, -0.3, 0).finished()).t()).norm(),
            1e-14);
}

// The quaternion's length is divided out, so that the derivative by each of the seven parameters
// falls with it.
TEST(CeresCost, HasTheDerivativeByTheSevenParameters) {
  ResidualSampler sampler(3);
  const SE3d T = sampler.Pose(3, 1);
  const PointToPoint metric = PointToPoint::From(sampler.Pair(T, 1));
  double x[7], r[3], J[21];
  T.ToParameters(x);
  for (int i = 0; i < 4; ++i) {
    x[i] *= 3;
  }
  const double* parameters[] = {x};
  double* jacobians[] = {J};
  ASSERT_TRUE(CeresCost<PointToPoint>(metric).Evaluate(parameters, r, jacobians));
  for (int k = 0; k < 7; ++k) {
    constexpr double h = 1e-6;
    const double middle = x[k];
    x[k] = middle + h;
    const Vec3 ahead = metric.Residual(SE3d::FromParameters(x));
    x[k] = middle - h;
    const Vec3 back = metric.Residual(SE3d::FromParameters(x));
    x[k] = middle;
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR(J[7 * row + k], (ahead[row] - back[row]) / (2 * h), 1e-7) << k;
    }
  }
}

}  // namespace
}  // namespace icpscape
