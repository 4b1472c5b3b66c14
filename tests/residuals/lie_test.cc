// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/lie.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <random>
#include <unsupported/Eigen/MatrixFunctions>

namespace icpscape {
namespace {

using Mat4 = Mat<double, 4, 4>;

Mat4 Hat(const Vec6& xi) {
  Mat4 m = Mat4::Zero();
  m.topLeftCorner<3, 3>() = Skew<double>(xi.head<3>());
  m.topRightCorner<3, 1>() = xi.tail<3>();
  return m;
}

Vec6 RandomTwist(std::mt19937* engine, double angle) {
  std::normal_distribution<double> normal;
  Vec6 xi;
  for (int i = 0; i < 6; ++i) {
    xi[i] = normal(*engine);
  }
  xi.head<3>() *= angle / xi.head<3>().norm();
  return xi;
}

const double kAngles[] = {0,    1e-12, 1e-8,        1e-5,        1e-4,       1e-3,
                          0.01, 0.1,   0.4999,      0.5001,      1,          2,
                          3,    3.1,   M_PI - 1e-3, M_PI - 1e-6, M_PI - 1e-9};

TEST(Lie, ExpIsTheMatrixExponential) {
  std::mt19937 engine(1);
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      const Vec6 xi = RandomTwist(&engine, angle);
      const Mat4 expected = Hat(xi).exp();
      EXPECT_LE((SE3d::Exp(xi).Matrix() - expected).norm(), 1e-13) << "angle " << angle;
    }
  }
}

TEST(Lie, LogInvertsExp) {
  std::mt19937 engine(2);
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      const Vec6 xi = RandomTwist(&engine, angle);
      const Vec6 back = SE3d::Exp(xi).Log();
      EXPECT_LE((back - xi).norm(), 2e-13 * (1 + xi.norm())) << "angle " << angle;
    }
  }
}

TEST(Lie, SmallRotationsKeepTheirDigits) {
  // 1e-9 rad must come back to full precision, not to 1e-9 * eps * 1e9.
  const Vec6 xi = (Vec6() << 1e-9, -2e-9, 3e-9, 1, 2, 3).finished();
  EXPECT_LE((SE3d::Exp(xi).Log().head<3>() - xi.head<3>()).norm(), 1e-24);
}

// The closed forms in long double are the second method. It loses three digits at an angle of 0.05,
// and has them to spare; below that the first terms of the series tell.
TEST(Lie, CoefficientsAreRightToTheLastDigits) {
  for (const double theta : {0.05, 0.1, 0.2, 0.3, 0.4, 0.45, 0.4999, 0.5001, 0.7, 1.0, 2.0, 3.0}) {
    const double theta2 = theta * theta;
    const long double t = std::sqrt(static_cast<long double>(theta2));
    const auto expect_near = [&](double value, long double expected) {
      EXPECT_NEAR(value / static_cast<double>(expected), 1, 7e-16) << "angle " << theta;
    };
    expect_near(internal::SinOverAngle(theta2), std::sin(t) / t);
    expect_near(internal::OneMinusCosOverAngle2(theta2), 2 * std::pow(std::sin(t / 2) / t, 2.0L));
    if (theta < 0.5) {  // Beyond, the closed forms' own cancellation shows.
      expect_near(internal::AngleMinusSinOverAngle3(theta2), (t - std::sin(t)) / (t * t * t));
      expect_near(internal::InverseJacobianCoefficient(theta2),
                  (1 - t / 2 * std::cos(t / 2) / std::sin(t / 2)) / (t * t));
    }
  }
}

// Where the logarithm of a rotation goes over to its series, both are right to the last digits.
TEST(Lie, LogOfRotationsAboutTheSeriesBorder) {
  for (const double half : {1e-7, 3e-6, 9.9e-6, 1.01e-5, 1e-4, 9e-4, 0.01}) {
    const Mat3 R = Eigen::Quaterniond(std::cos(half), std::sin(half), 0, 0).toRotationMatrix();
    EXPECT_NEAR(SE3d(R, Vec3::Zero()).LogRotation().x() / (2 * half), 1, 2e-15) << half;
  }
}

TEST(Lie, LogAtExactlyPiGivesARotationByPi) {
  for (const Vec3& axis :
       {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 2, -2).normalized().eval()}) {
    const Mat3 R = 2 * axis * axis.transpose() - Mat3::Identity();
    const Vec3 omega = SE3d(R, Vec3::Zero()).LogRotation();
    EXPECT_NEAR(omega.norm(), M_PI, 1e-15);
    EXPECT_NEAR(std::abs(omega.dot(axis)), M_PI, 1e-14);
  }
}

TEST(Lie, AdjointMovesTwistsAcross) {
  std::mt19937 engine(3);
  for (int i = 0; i < 100; ++i) {
    const SE3d T = SE3d::Exp(RandomTwist(&engine, 2));
    const Vec6 xi = RandomTwist(&engine, 1);
    const Mat4 left = (T * SE3d::Exp(xi) * T.Inverse()).Matrix();
    EXPECT_LE((left - SE3d::Exp(T.Adjoint() * xi).Matrix()).norm(), 1e-12);
  }
}

TEST(Lie, GroupLaws) {
  std::mt19937 engine(4);
  const SE3d A = SE3d::Exp(RandomTwist(&engine, 1));
  const SE3d B = SE3d::Exp(RandomTwist(&engine, 2));
  const Vec3 p(1, 2, 3);
  EXPECT_LE(((A * B) * p - A * (B * p)).norm(), 1e-14);
  EXPECT_LE(((A * A.Inverse()).Matrix() - Mat4::Identity()).norm(), 1e-14);
  EXPECT_LE((A.Matrix() * B.Matrix() - (A * B).Matrix()).norm(), 1e-14);
}

TEST(Lie, ParametersGoRoundAndForgiveLength) {
  std::mt19937 engine(5);
  for (const double angle : kAngles) {
    const SE3d T = SE3d::Exp(RandomTwist(&engine, angle));
    double x[7];
    T.ToParameters(x);
    EXPECT_LE((SE3d::FromParameters(x).Matrix() - T.Matrix()).norm(), 1e-14);
    for (int i = 0; i < 4; ++i) {
      x[i] *= 3;
    }
    EXPECT_LE((SE3d::FromParameters(x).Matrix() - T.Matrix()).norm(), 1e-14);
  }
}

TEST(Lie, NormalizedProjectsRoundedMatrices) {
  std::mt19937 engine(6);
  const SE3d T = SE3d::Exp(RandomTwist(&engine, 1));
  const Mat3 rounded = (T.R() * 1e6).array().round() / 1e6;
  const Mat3 R = SE3d(rounded, T.t()).Normalized().R();
  EXPECT_LE((R.transpose() * R - Mat3::Identity()).norm(), 1e-15);
  EXPECT_LE((R - T.R()).norm(), 3e-6);
}

// Jets must stay finite where sqrt and atan2 have no derivative, and be right there.
TEST(Lie, JetsThroughExpAndLogAtTheIdentity) {
  using Jet = ceres::Jet<double, 6>;
  Vec<Jet, 6> xi;
  for (int i = 0; i < 6; ++i) {
    xi[i] = Jet(0.0, i);
  }
  const Vec<Jet, 6> back = SE3<Jet>::Exp(xi).Log();
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(back[i].a, 0);
    EXPECT_LE((back[i].v - Vec6::Unit(i)).norm(), 1e-15);
  }
}

// d Log(T Exp(delta)) / d delta by Jets against differences, also where Log is near pi.
TEST(Lie, JetsThroughLogAwayFromTheIdentity) {
  using Jet = ceres::Jet<double, 6>;
  std::mt19937 engine(7);
  for (const double angle : {1e-6, 0.01, 0.49, 0.51, 1.0, 2.5, 3.1}) {
    const SE3d T = SE3d::Exp(RandomTwist(&engine, angle));
    Vec<Jet, 6> delta;
    for (int i = 0; i < 6; ++i) {
      delta[i] = Jet(0.0, i);
    }
    const Vec<Jet, 6> log = (T.cast<Jet>() * SE3<Jet>::Exp(delta)).Log();
    constexpr double h = 1e-5;
    for (int i = 0; i < 6; ++i) {
      const Vec6 numeric =
          ((T * SE3d::Exp(h * Vec6::Unit(i))).Log() - (T * SE3d::Exp(-h * Vec6::Unit(i))).Log()) /
          (2 * h);
      for (int row = 0; row < 6; ++row) {
        EXPECT_NEAR(log[row].v[i], numeric[row], 1e-6) << "angle " << angle;
      }
    }
  }
}

}  // namespace
}  // namespace icpscape
