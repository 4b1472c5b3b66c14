// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_TESTING_RESIDUAL_TEST_SUITE_H_
#define ICPSCAPE_TESTS_TESTING_RESIDUAL_TEST_SUITE_H_

// The tests that every metric must pass, for ours and for users' own:
//
//   #include "icpscape/testing/residual_test_suite.h"
//   INSTANTIATE_TYPED_TEST_SUITE_P(PointToPlane, ResidualTest, icpscape::PointToPlane);
//
// Derivatives are held against automatic and numeric ones, against the Taylor expansion (which
// needs no tolerance on the derivative itself) and through Ceres' own checker. What differs from
// metric to metric (null space, non-smooth set, which frames it may depend on) is declared by
// specialising ResidualProperties.

#include <ceres/gradient_checker.h>
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "icpscape/residuals/adapters/ceres.h"
#include "icpscape/residuals/correspondence.h"
#include "icpscape/residuals/lie.h"
#include "icpscape/testing/residual_sampler.h"

namespace icpscape {

/// What a metric's documentation claims beyond its formula. Every metric declares it, by a
/// specialisation with
///   kInvariantToTargetFrame   whether |r| stays the same when the target frame alone is changed
///                             (T with it)
///   IsSmoothAt(metric, T)     false on the metric's non-smooth set and near it: there only
///                             finiteness is asked for
///   NullSpace(metric, T)      all directions xi to which a single pair is blind at T, J xi = 0, by
///                             a basis of them
template <class Metric>
struct ResidualProperties;

/// The first two of most metrics, to be derived from.
struct InvariantAndSmooth {
  static constexpr bool kInvariantToTargetFrame = true;
  template <class Metric>
  static bool IsSmoothAt(const Metric& /*metric*/, const SE3d& /*T*/) {
    return true;
  }
};

/// A twist that moves the body without turning it.
inline Vec6 Slide(const Vec3& v) {
  Vec6 xi;
  xi << Vec3::Zero(), v;
  return xi;
}

/// A twist that turns about the source point p: [omega; p x omega] leaves p where it is.
inline Vec6 RotationAbout(const Vec3& p_source, const Vec3& omega) {
  Vec6 xi;
  xi << omega, p_source.cross(omega);
  return xi;
}

/// The turns about the source point p, axis by axis, each with a slide of its own, slide(omega).
template <class SlideOf>
std::vector<Vec6> RotationsAbout(const Vec3& p_source, const SlideOf& slide) {
  std::vector<Vec6> twists;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 omega = Vec3::Unit(axis);
    twists.push_back(RotationAbout(p_source, omega) + Slide(slide(omega)));
  }
  return twists;
}
inline std::vector<Vec6> RotationsAbout(const Vec3& p_source) {
  return RotationsAbout(p_source, [](const Vec3& /*omega*/) { return Vec3(Vec3::Zero()); });
}

/// The twists given and the two slides across a direction.
inline std::vector<Vec6> WithSlidesAcross(const Vec3& direction, std::vector<Vec6> twists) {
  const Vec3 across = direction.unitOrthogonal();
  twists.push_back(Slide(across));
  twists.push_back(Slide(direction.normalized().cross(across)));
  return twists;
}

template <class M>
class ResidualTest : public ::testing::Test {
 protected:
  struct Sample {
    Correspondence pair;
    M metric;
    SE3d T;
  };

  /// 1000 random poses and the hard ones.
  static std::vector<Sample> Samples() {
    ResidualSampler sampler(42);
    std::vector<Sample> samples;
    const auto add = [&](const SE3d& T, double distance) {
      const Correspondence pair = sampler.Pair(T, distance);
      samples.push_back({pair, M::From(pair), T});
    };
    for (int i = 0; i < 1000; ++i) {
      add(sampler.Pose(5, sampler.Uniform(0, 3)), 1);
    }
    add(SE3d(), 1);
    add(sampler.Pose(1, 1e-8), 1);
    add(sampler.Pose(1, M_PI - 1e-6), 1);
    add(sampler.Pose(1e4, 1), 1);
    add(sampler.Pose(5, 1), 0);  // A perfect match: r = 0.
    add(SE3d(), 0);
    {
      Correspondence flipped = samples.front().pair;
      flipped.n_source = -flipped.n_source;
      samples.push_back({flipped, M::From(flipped), samples.front().T});
      flipped.n_target = -flipped.n_target;
      samples.push_back({flipped, M::From(flipped), samples.front().T});
      Correspondence origin = samples.front().pair;
      origin.p_source.setZero();
      samples.push_back({origin, M::From(origin), samples.front().T});
    }
    return samples;
  }

  static std::vector<Sample> SmoothSamples() {
    std::vector<Sample> smooth;
    for (const Sample& sample : Samples()) {
      if (ResidualProperties<M>::IsSmoothAt(sample.metric, sample.T)) {
        smooth.push_back(sample);
      }
    }
    return smooth;
  }

  static Mat<double, M::kDim, 6> AutodiffJacobian(const Sample& sample) {
    using Jet = ceres::Jet<double, 6>;
    Vec<Jet, 6> xi;
    for (int i = 0; i < 6; ++i) {
      xi[i] = Jet(0.0, i);
    }
    const Vec<Jet, M::kDim> r =
        sample.metric.Residual(sample.T.template cast<Jet>() * SE3<Jet>::Exp(xi));
    Mat<double, M::kDim, 6> J;
    for (int row = 0; row < M::kDim; ++row) {
      J.row(row) = r[row].v.transpose();
    }
    return J;
  }

  static Mat<double, M::kDim, 6> NumericJacobian(const Sample& sample, double h) {
    Mat<double, M::kDim, 6> J;
    for (int i = 0; i < 6; ++i) {
      const Vec6 step = h * Vec6::Unit(i);
      J.col(i) = (sample.metric.Residual(sample.T * SE3d::Exp(step)) -
                  sample.metric.Residual(sample.T * SE3d::Exp(-step))) /
                 (2 * h);
    }
    return J;
  }
};

TYPED_TEST_SUITE_P(ResidualTest);

TYPED_TEST_P(ResidualTest, JacobianMatchesAutodiff) {
  for (const auto& sample : this->SmoothSamples()) {
    const auto J = sample.metric.Jacobian(sample.T);
    const auto expected = this->AutodiffJacobian(sample);
    EXPECT_LE((J - expected).norm(), 1e-12 * expected.norm()) << "at\n"
                                                              << sample.T.Matrix() << "\nanalytic\n"
                                                              << J << "\nautodiff\n"
                                                              << expected;
  }
}

TYPED_TEST_P(ResidualTest, JacobianMatchesCentralDifferences) {
  constexpr double h = 1e-6;
  for (const auto& sample : this->SmoothSamples()) {
    const auto J = sample.metric.Jacobian(sample.T);
    const auto expected = this->NumericJacobian(sample, h);
    // The second term is the rounding of the difference quotient itself.
    const double tolerance =
        1e-7 * (1 + J.norm()) + 10 * std::numeric_limits<double>::epsilon() *
                                    (sample.T.t().norm() + sample.pair.p_source.norm()) / h;
    EXPECT_LE((J - expected).norm(), tolerance) << "at\n" << sample.T.Matrix();
  }
}

// |r(T Exp(h xi)) - r - h J xi| must fall with h^2: slope 2 in a log-log plot, whatever the scale.
TYPED_TEST_P(ResidualTest, TaylorRemainderIsOfSecondOrder) {
  ResidualSampler sampler(7);
  double coarse = 0;
  double fine = 0;
  constexpr double kCoarse = 1e-3;
  constexpr double kFine = 1e-4;
  for (const auto& sample : this->SmoothSamples()) {
    if (sample.T.t().norm() > 1e3) {
      continue;  // The remainder would drown in rounding.
    }
    Vec6 xi;
    xi << sampler.UnitVector(), sampler.UnitVector();
    const auto r = sample.metric.Residual(sample.T);
    const auto J = sample.metric.Jacobian(sample.T);
    const auto remainder = [&](double h) {
      return (sample.metric.Residual(sample.T * SE3d::Exp(h * xi)) - r - h * (J * xi))
          .squaredNorm();
    };
    coarse += remainder(kCoarse);
    fine += remainder(kFine);
  }
  ASSERT_GT(fine, 0);
  const double slope = 0.5 * std::log(coarse / fine) / std::log(kCoarse / kFine);
  EXPECT_GT(slope, 1.9);
  EXPECT_LT(slope, 2.1);
}

TYPED_TEST_P(ResidualTest, CeresCostPassesGradientChecker) {
  const SE3Manifold manifold;
  const std::vector<const ceres::Manifold*> manifolds = {&manifold};
  // Ridders' method starts 32 times wider than this. From Ceres' 1e-2 it takes a coincidence
  // between two coarse steps for convergence now and then, and a lever of 40 m turns it into
  // metres.
  ceres::NumericDiffOptions numeric_options;
  numeric_options.ridders_relative_initial_step_size = 1e-5;
  int checked = 0;
  for (const auto& sample : this->SmoothSamples()) {
    if (++checked > 50 && sample.T.t().norm() < 1e3) {
      continue;  // The checker takes milliseconds a sample; the hard ones are at the end.
    }
    const CeresCost<TypeParam> cost(sample.metric);
    const ceres::GradientChecker checker(&cost, &manifolds, numeric_options);
    double x[7];
    sample.T.ToParameters(x);
    const double* parameters[] = {x};
    ceres::GradientChecker::ProbeResults results;
    checker.Probe(parameters, 1e-7, &results);
    ASSERT_TRUE(results.return_value);
    // Compared by matrix norm: entry by entry, a 1e-17 against a 1e-12 would fail.
    const ceres::Matrix& analytic = results.local_jacobians[0];
    const ceres::Matrix& numeric = results.local_numeric_jacobians[0];
    const double rounding = 1e-9 * sample.T.t().norm();
    EXPECT_LE((analytic - numeric).norm(), 1e-7 * (1 + numeric.norm()) + rounding)
        << "analytic\n"
        << analytic << "\nnumeric\n"
        << numeric;
    EXPECT_LE((analytic - sample.metric.Jacobian(SE3d::FromParameters(x))).norm(),
              1e-12 * (1 + analytic.norm()));
    // Without Jacobians the residual is the same, bit for bit.
    Vec<double, TypeParam::kDim> r;
    ASSERT_TRUE(cost.Evaluate(parameters, r.data(), nullptr));
    EXPECT_EQ((r - results.residuals).norm(), 0);
  }
}

// Every direction that a metric declares is flat, and as many are declared as there are.
TYPED_TEST_P(ResidualTest, DocumentedNullSpaceIsFlat) {
  const auto rank = [](const Eigen::MatrixXd& m) {
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(m);
    return (svd.singularValues().array() > 1e-7 * svd.singularValues()[0]).count();
  };
  for (const auto& sample : this->SmoothSamples()) {
    const auto J = sample.metric.Jacobian(sample.T);
    const std::vector<Vec6> declared =
        ResidualProperties<TypeParam>::NullSpace(sample.metric, sample.T);
    EXPECT_EQ(static_cast<long>(declared.size()), 6 - rank(J)) << "at\n" << sample.T.Matrix();
    Eigen::MatrixXd basis(6, declared.size());
    for (std::size_t k = 0; k < declared.size(); ++k) {
      basis.col(static_cast<long>(k)) = declared[k].normalized();
      EXPECT_LE((J * declared[k]).norm(), 1e-10 * (1 + J.norm() * declared[k].norm())) << k;
    }
    EXPECT_TRUE(declared.empty() || rank(basis) == basis.cols());
  }
}

TYPED_TEST_P(ResidualTest, FiniteEverywhere) {
  for (const auto& sample : this->Samples()) {
    EXPECT_TRUE(sample.metric.Residual(sample.T).allFinite());
    EXPECT_TRUE(sample.metric.Jacobian(sample.T).allFinite());
  }
}

TYPED_TEST_P(ResidualTest, ZeroAtAPerfectMatch) {
  ResidualSampler sampler(3);
  for (int i = 0; i < 100; ++i) {
    const SE3d T = sampler.Pose(5, 1);
    const TypeParam metric = TypeParam::From(sampler.Pair(T, 0));
    EXPECT_LE(metric.Residual(T).norm(), 1e-12);
  }
}

// Moving both frames alike must change nothing: p' = G p, q' = G q, T' = G T G^-1.
TYPED_TEST_P(ResidualTest, InvariantToACommonChangeOfFrames) {
  ResidualSampler sampler(11);
  for (const auto& sample : this->SmoothSamples()) {
    const SE3d G = sampler.Pose(5, 2);
    const TypeParam moved = TypeParam::From(ChangeFrames(sample.pair, G, G));
    const double size = 1 + sample.T.t().norm() + sample.pair.p_source.norm();
    EXPECT_NEAR(moved.Residual(G * sample.T * G.Inverse()).norm(),
                sample.metric.Residual(sample.T).norm(), 1e-12 * size);
  }
}

TYPED_TEST_P(ResidualTest, TargetFrameMattersOnlyWhereDocumented) {
  ResidualSampler sampler(13);
  double largest = 0;
  for (const auto& sample : this->SmoothSamples()) {
    const SE3d G = sampler.Pose(5, 1);
    const TypeParam moved = TypeParam::From(ChangeFrames(sample.pair, SE3d(), G));
    const double size = 1 + sample.T.t().norm() + sample.pair.p_source.norm();
    const double change =
        std::abs(moved.Residual(G * sample.T).norm() - sample.metric.Residual(sample.T).norm());
    largest = std::max(largest, change / size);
  }
  if (ResidualProperties<TypeParam>::kInvariantToTargetFrame) {
    EXPECT_LE(largest, 1e-12);
  } else {
    EXPECT_GE(largest, 1e-3) << "documented to depend on the target frame, but does not";
  }
}

REGISTER_TYPED_TEST_SUITE_P(ResidualTest, JacobianMatchesAutodiff,
                            JacobianMatchesCentralDifferences, TaylorRemainderIsOfSecondOrder,
                            CeresCostPassesGradientChecker, DocumentedNullSpaceIsFlat,
                            FiniteEverywhere, ZeroAtAPerfectMatch, InvariantToACommonChangeOfFrames,
                            TargetFrameMattersOnlyWhereDocumented);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_TESTING_RESIDUAL_TEST_SUITE_H_
