// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/symmetric.h"

#include "icpscape/testing/residual_test_suite.h"

namespace icpscape {

// In the source frame: the pair's vector e, R^T (T p - q), and what the residual projects it on.

template <>
struct ResidualProperties<Symmetric> : InvariantAndSmooth {
  static constexpr bool kInvariantToTargetFrame = false;
  static std::vector<Vec6> NullSpace(const Symmetric& metric, const SE3d& T) {
    return WithSlidesAcross(T.R().transpose() * metric.n_sum, RotationsAbout(metric.p_source));
  }
};

// A turn about the point leaves e, but turns n_p: the residual changes by e . (omega x n_p), which
// a slide along m takes back.
template <>
struct ResidualProperties<SymmetricRotated> : InvariantAndSmooth {
  static std::vector<Vec6> NullSpace(const SymmetricRotated& metric, const SE3d& T) {
    const Vec3 m = metric.n_source + T.R().transpose() * metric.n_target;
    const Vec3 e = T.R().transpose() * (T * metric.p_source - metric.q_target);
    return WithSlidesAcross(m, RotationsAbout(metric.p_source, [&](const Vec3& omega) -> Vec3 {
                              return -e.dot(omega.cross(metric.n_source)) / m.squaredNorm() * m;
                            }));
  }
};

// Here the turn of R^1/2 has no simple form, so that it is taken by differences: e . H m changes by
// e . dH m while R turns by Exp(omega).
template <>
struct ResidualProperties<SymmetricSplit> : InvariantAndSmooth {
  static constexpr bool kInvariantToTargetFrame = false;
  // The square root of a rotation jumps where the rotation reaches pi.
  static bool IsSmoothAt(const SymmetricSplit& /*metric*/, const SE3d& T) {
    return T.LogRotation().norm() < M_PI - 1e-3;
  }
  static std::vector<Vec6> NullSpace(const SymmetricSplit& metric, const SE3d& T) {
    const auto turned_sum = [&](const Vec3& omega) -> Vec3 {
      const SE3d turned(T.R() * SE3d::Exp((Vec6() << omega, Vec3::Zero()).finished()).R(), T.t());
      return Eigen::AngleAxisd(turned.LogRotation().norm() / 2, turned.LogRotation().normalized()) *
             metric.n_sum;
    };
    const Vec3 m = T.R().transpose() * turned_sum(Vec3::Zero());
    const Vec3 e = T * metric.p_source - metric.q_target;
    constexpr double h = 1e-3;
    return WithSlidesAcross(m, RotationsAbout(metric.p_source, [&](const Vec3& omega) -> Vec3 {
                              const Vec3 d =
                                  (8 * (turned_sum(h * omega) - turned_sum(-h * omega)) -
                                   turned_sum(2 * h * omega) + turned_sum(-2 * h * omega)) /
                                  (12 * h);
                              return -e.dot(d) / m.squaredNorm() * m;
                            }));
  }
};

// As for the rotated form; the slide must leave e . n_q alone.
template <>
struct ResidualProperties<TwoPlane> : InvariantAndSmooth {
  static std::vector<Vec6> NullSpace(const TwoPlane& metric, const SE3d& T) {
    const Vec3 n_q = T.R().transpose() * metric.n_target;
    const Vec3 e = T.R().transpose() * (T * metric.p_source - metric.q_target);
    const Vec3 u = metric.n_source - metric.n_source.dot(n_q) * n_q;
    std::vector<Vec6> twists = RotationsAbout(metric.p_source, [&](const Vec3& omega) -> Vec3 {
      return -e.dot(omega.cross(metric.n_source)) / u.dot(metric.n_source) * u;
    });
    twists.push_back(Slide(metric.n_source.cross(n_q)));
    return twists;
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Symmetric, ResidualTest, Symmetric);
INSTANTIATE_TYPED_TEST_SUITE_P(SymmetricRotated, ResidualTest, SymmetricRotated);
INSTANTIATE_TYPED_TEST_SUITE_P(SymmetricSplit, ResidualTest, SymmetricSplit);
INSTANTIATE_TYPED_TEST_SUITE_P(TwoPlane, ResidualTest, TwoPlane);

namespace {

Correspondence Pair() {
  Correspondence c;
  c.p_source = {1, 2, 3};
  c.q_target = {1, 1, 1};
  c.n_source = {0, 0, 1};
  c.n_target = {0, 1, 0};
  return c;
}

}  // namespace

// At the identity e = (0, 1, 2): e . n_p = 2, e . n_q = 1.
TEST(Symmetric, KnownValuesAtTheIdentity) {
  EXPECT_EQ(Symmetric::From(Pair()).Residual(SE3d())[0], 3);
  EXPECT_EQ(SymmetricRotated::From(Pair()).Residual(SE3d())[0], 3);
  EXPECT_EQ(SymmetricSplit::From(Pair()).Residual(SE3d())[0], 3);
  const Vec<double, 2> both = TwoPlane::From(Pair()).Residual(SE3d());
  EXPECT_EQ(both[0], 1);
  EXPECT_EQ(both[1], 2);
}

// A quarter turn about x takes p to (1, -3, 2), so e = (0, -4, 1); n_p turns to (0, -1, 0).
TEST(Symmetric, KnownValuesAfterAQuarterTurn) {
  Mat3 R;
  R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const SE3d T(R, Vec3::Zero());
  // Normals stay: e . ((0,0,1) + (0,1,0)) = 1 - 4.
  EXPECT_NEAR(Symmetric::From(Pair()).Residual(T)[0], -3, 1e-15);
  // n_p turned: e . ((0,-1,0) + (0,1,0)) = 0.
  EXPECT_NEAR(SymmetricRotated::From(Pair()).Residual(T)[0], 0, 1e-15);
  // The sum (0, 1, 1) turned by an eighth points along z: e . (0, 0, sqrt 2).
  EXPECT_NEAR(SymmetricSplit::From(Pair()).Residual(T)[0], std::sqrt(2.0), 1e-14);
  const Vec<double, 2> both = TwoPlane::From(Pair()).Residual(T);
  EXPECT_NEAR(both[0], -4, 1e-15);
  EXPECT_NEAR(both[1], 4, 1e-15);
}

// Rusinkiewicz 2019 writes the residual with both clouds turned half way, about the rotation's half
// Q: (Q p - Q^-1 q + t') . n with R = Q Q and t = Q t'.
TEST(Symmetric, RotatedAndSplitEqualRusinkiewiczsForms) {
  ResidualSampler sampler(5);
  for (int i = 0; i < 1000; ++i) {
    const SE3d T = sampler.Pose(3, sampler.Uniform(0, 3));
    const Correspondence c = sampler.Pair(T, 1);
    const Vec3 half = T.LogRotation() / 2;
    const Mat3 Q = Eigen::AngleAxisd(half.norm(), half.normalized()).toRotationMatrix();
    const Vec3 t_half = Q.transpose() * T.t();
    const Vec3 e = Q * c.p_source - Q.transpose() * c.q_target + t_half;
    const Vec3 turned = Q * c.n_source + Q.transpose() * c.n_target;
    EXPECT_NEAR(SymmetricRotated::From(c).Residual(T)[0], e.dot(turned), 1e-12);
    const Vec3 fixed = c.n_source + c.n_target;
    EXPECT_NEAR(SymmetricSplit::From(c).Residual(T)[0], e.dot(fixed), 1e-12);
  }
}

TEST(Symmetric, TwoPlaneContainsPointToPlaneBothWays) {
  ResidualSampler sampler(6);
  for (int i = 0; i < 100; ++i) {
    const SE3d T = sampler.Pose(3, 1);
    const Correspondence c = sampler.Pair(T, 1);
    const Vec<double, 2> r = TwoPlane::From(c).Residual(T);
    EXPECT_NEAR(r[0], c.n_target.dot(T * c.p_source - c.q_target), 1e-13);
    // The other way round: q seen from the source, off the plane through p.
    EXPECT_NEAR(r[1], -c.n_source.dot(T.Inverse() * c.q_target - c.p_source), 1e-13);
  }
}

}  // namespace icpscape
