// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icpscape {
namespace {

// A different number in every place.
BlockSums Block() {
  BlockSums block = {};
  block.count = 7;
  block.cost = 1.5;
  block.sum_squared = 2.5;
  block.epsilon = 4.5;
  for (int i = 0; i < 6; ++i) {
    block.gradient[i] = 10 + i;
    block.epsilon_gradient[i] = 20 + i;
  }
  for (int entry = 0; entry < 21; ++entry) {
    block.hessian[entry] = 100 + entry;
  }
  return block;
}

// Those numbers times a factor.
void ExpectTimes(const Evaluation& sums, double factor) {
  EXPECT_DOUBLE_EQ(sums.sums.cost, factor * 1.5);
  EXPECT_DOUBLE_EQ(sums.sum_squared, factor * 2.5);
  EXPECT_DOUBLE_EQ(sums.epsilon, factor * 4.5);
  for (int i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(sums.sums.gradient[i], factor * (10 + i));
    EXPECT_DOUBLE_EQ(sums.epsilon_gradient[i], factor * (20 + i));
  }
  // The upper triangle row by row: the third row begins behind 6 + 5 entries.
  EXPECT_DOUBLE_EQ(sums.sums.Hessian()(0, 0), factor * 100);
  EXPECT_DOUBLE_EQ(sums.sums.Hessian()(0, 5), factor * 105);
  EXPECT_DOUBLE_EQ(sums.sums.Hessian()(2, 1), factor * 107);
  EXPECT_DOUBLE_EQ(sums.sums.Hessian()(2, 2), factor * 111);
  EXPECT_DOUBLE_EQ(sums.sums.Hessian()(5, 5), factor * 120);
}

TEST(Evaluation, TakesUpEverySumOfABlock) {
  Evaluation sums;
  sums.Add(Block());
  sums.Add(Block());
  sums.Add(Block());
  ExpectTimes(sums, 3);
  EXPECT_EQ(sums.n(), 21);
}

TEST(Evaluation, AddsAnotherTimesItsWeight) {
  Evaluation part, sums;
  part.Add(Block());
  sums.Add(part, 0.25);
  sums.Add(part, 2);
  ExpectTimes(sums, 2.25);
  EXPECT_EQ(sums.n(), 14);  // Pairs are counted, not weighed.
}

TEST(Evaluation, RemembersALossThatCurvesUpwards) {
  BlockSums upward = Block();
  upward.upward_loss = true;
  Evaluation first, last;
  first.Add(upward);
  first.Add(Block());
  last.Add(Block());
  EXPECT_FALSE(last.sums.upward_loss);
  last.Add(upward);
  EXPECT_TRUE(first.sums.upward_loss);
  EXPECT_TRUE(last.sums.upward_loss);
  Evaluation straight, before, after;
  straight.Add(Block());
  before.Add(first, 0.5);
  before.Add(straight, 0.5);
  after.Add(straight, 0.5);
  EXPECT_FALSE(after.sums.upward_loss);
  after.Add(first, 0.5);
  EXPECT_TRUE(before.sums.upward_loss);
  EXPECT_TRUE(after.sums.upward_loss);
}

TEST(Evaluation, ReadingsByHand) {
  Evaluation sums;
  sums.sums.num_correspondences = 8;
  sums.epsilon = 2;
  sums.sum_squared = 18;
  EXPECT_DOUBLE_EQ(sums.Rmse(), 0.5);
  EXPECT_DOUBLE_EQ(sums.RmsResidual(), 1.5);
  // d sqrt(eps / n) / du = (d eps / du) / (2 n rmse), with d eps / du = 3 * 2 + 5 * (-0.2) = 5.
  sums.epsilon_gradient << 0, 3, 0, 0, 0, 5;
  sums.sums.gradient << 1, 1, 1, 1, 1, 1;  // That of the cost does not matter.
  const Vec6 twist = (Vec6() << 7, 2, 0, 0, 0, -0.2).finished();
  EXPECT_DOUBLE_EQ(sums.RmseSlope(twist), 5. / 8);
  EXPECT_TRUE(std::isnan(Evaluation().Rmse()));
  EXPECT_TRUE(std::isnan(Evaluation().RmsResidual()));
}

}  // namespace
}  // namespace icpscape
