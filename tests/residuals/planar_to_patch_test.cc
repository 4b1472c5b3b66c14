// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/planar_to_patch.h"

#include <ceres/loss_function.h>

#include "icpscape/testing/residual_test_suite.h"

namespace icpscape {

template <>
struct ResidualProperties<PlanarToPatch> : InvariantAndSmooth {
  static std::vector<Vec6> NullSpace(const PlanarToPatch& metric, const SE3d& /*T*/) {
    return RotationsAbout(metric.p_source);
  }
};

template <>
struct ResidualProperties<PlanarToPlane> : InvariantAndSmooth {
  static std::vector<Vec6> NullSpace(const PlanarToPlane& metric, const SE3d& T) {
    return WithSlidesAcross(T.R().transpose() * metric.plane.n_target,
                            RotationsAbout(metric.plane.p_source));
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(PlanarToPatch, ResidualTest, PlanarToPatch);
INSTANTIATE_TYPED_TEST_SUITE_P(PlanarToPlane, ResidualTest, PlanarToPlane);

namespace {

// The printed fraction, from three virtual points: |[Tp - q_j; n]| / |n| with
// n = (q_j - q_k) x (q_j - q_l).
double Printed(const Vec3& p, const Vec3& q_j, const Vec3& q_k, const Vec3& q_l) {
  const Vec3 n = (q_j - q_k).cross(q_j - q_l);
  Vec6 stacked;
  stacked << p - q_j, n;
  return stacked.norm() / n.norm();
}

}  // namespace

TEST(PlanarToPatch, SoftLOneLossMakesItThePrintedTerm) {
  ResidualSampler sampler(1);
  const ceres::SoftLOneLoss loss(1);
  for (int i = 0; i < 1000; ++i) {
    const SE3d T = sampler.Pose(3, 1);
    Correspondence c = sampler.Pair(T, 1);
    const double legs = sampler.Uniform(0.1, 1);
    const Vec3 e_1 = legs * c.n_patch.unitOrthogonal();
    const Vec3 e_2 = legs * c.n_patch.cross(e_1).normalized();
    c.area_patch = legs * legs;
    const double printed = Printed(T * c.p_source, c.q_patch, c.q_patch + e_1, c.q_patch + e_2);
    double rho[3];
    const double squared = PlanarToPatch::From(c).Residual(T).squaredNorm();
    loss.Evaluate(squared, rho);
    EXPECT_NEAR(0.5 * rho[0], printed - 1, 1e-12 * printed);
    EXPECT_NEAR(EvaluateEpsilon(PlanarToPatch::kEpsilon, squared).value, printed - 1,
                1e-12 * printed);
  }
}

// The triangle's size decides the scale: 1 m off a patch with legs of 0.1, 0.3 and 0.5 m costs
// about 99, 10.2 and 3.1.
TEST(PlanarToPatch, KnownValuesAtOneMetre) {
  for (const auto& [legs, cost] : {std::pair(0.1, 99.005), {0.3, 10.1561}, {0.5, 3.1231}}) {
    const PlanarToPatch metric{{0, 0, 1}, {0, 0, 0}, legs * legs};
    const double squared = metric.Residual(SE3d()).squaredNorm();
    EXPECT_NEAR(EvaluateEpsilon(Epsilon::kSoftNorm, squared).value, cost, 1e-3);
  }
}

// Not a plane metric: 1 m within the plane costs the same as 1 m off it. LOAM's distance knows the
// difference.
TEST(PlanarToPatch, DoesNotKnowThePlane) {
  Correspondence c;
  c.p_source = c.q_patch = Vec3::Zero();
  c.n_patch = Vec3::UnitZ();
  c.area_patch = 0.25;
  const SE3d slide(Mat3::Identity(), Vec3(1, 0, 0));
  const SE3d lift(Mat3::Identity(), Vec3(0, 0, 1));
  EXPECT_EQ(PlanarToPatch::From(c).Residual(slide).norm(), 4);
  EXPECT_EQ(PlanarToPatch::From(c).Residual(lift).norm(), 4);
  EXPECT_EQ(PlanarToPlane::From(c).Residual(slide)[0], 0);
  EXPECT_EQ(PlanarToPlane::From(c).Residual(lift)[0], 1);
}

TEST(Epsilon, DerivativesAndEnds) {
  for (const Epsilon epsilon : {Epsilon::kSquared, Epsilon::kNorm, Epsilon::kSoftNorm}) {
    for (const double s : {1e-4, 0.1, 1.0, 50.0}) {
      const double h = 1e-5 * s;
      const double numeric =
          (EvaluateEpsilon(epsilon, s + h).value - EvaluateEpsilon(epsilon, s - h).value) / (2 * h);
      EXPECT_NEAR(EvaluateEpsilon(epsilon, s).derivative, numeric, 1e-8 * (1 + numeric));
    }
    EXPECT_EQ(EvaluateEpsilon(epsilon, 0).value, 0);
    EXPECT_TRUE(std::isfinite(EvaluateEpsilon(epsilon, 0).derivative));
  }
  EXPECT_EQ(EvaluateEpsilon(Epsilon::kSquared, 0).derivative, 1);
  EXPECT_EQ(EvaluateEpsilon(Epsilon::kNorm, 0).derivative, 0);  // In the middle of its kink.
  EXPECT_EQ(EvaluateEpsilon(Epsilon::kSoftNorm, 0).derivative, 0.5);
  // Small terms keep their digits: sqrt(1 + s) - 1 would lose them.
  EXPECT_NEAR(EvaluateEpsilon(Epsilon::kSoftNorm, 1e-12).value, 5e-13, 1e-24);
}

}  // namespace icpscape
