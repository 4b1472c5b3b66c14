// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/kinds.h"

#include <gtest/gtest.h>

#include "icpscape/testing/residual_sampler.h"

namespace icpscape {
namespace {

// A quarter turn about z and a step: x -> y, y -> -x.
const SE3d kTurn((Mat3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(), Vec3(10, 20, 30));

TEST(Kind, LooksFromAnotherFrameAsItShould) {
  EXPECT_EQ(kind::Point::InFrame<double>(kTurn, Vec3(1, 2, 3)), Vec3(8, 21, 33));
  EXPECT_EQ(kind::Direction::InFrame<double>(kTurn, Vec3(1, 2, 3)), Vec3(-2, 1, 3));
  const Mat3 C = (Mat3() << 1, 2, 3, 2, 4, 5, 3, 5, 6).finished();
  const Mat3 turned = (Mat3() << 4, -2, -5, -2, 1, 3, -5, 3, 6).finished();
  EXPECT_EQ(kind::Matrix::InFrame<double>(kTurn, C), turned);
  EXPECT_EQ(kind::Scalar::InFrame<double>(kTurn, 7), 7);
  // A covariance is the mean of d d^T: turned with the directions that it is made of.
  ResidualSampler sampler(1);
  const SE3d G = sampler.Pose(5, 2);
  const Vec3 d = sampler.Point(1);
  const Vec3 turned_d = kind::Direction::InFrame<double>(G, d);
  EXPECT_LE((kind::Matrix::InFrame<double>(G, d * d.transpose()) - turned_d * turned_d.transpose())
                .norm(),
            1e-14);
}

TEST(Kind, OfAMatrixIsItsUpperTriangleRowByRow) {
  const Mat3 C = (Mat3() << 1, 2, 3, 2, 4, 5, 3, 5, 6).finished();
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(kind::Matrix::NumberOf<double>(C, k), static_cast<double>(k + 1));
  }
  EXPECT_EQ(kind::Matrix::Make<double>([](std::size_t k) { return static_cast<double>(k + 1); }),
            C);
  EXPECT_EQ(kind::Matrix::Mark<double>(C), Vec3(1, 4, 6));
}

}  // namespace
}  // namespace icpscape
