// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/normal_equations.h"

#include <gtest/gtest.h>

namespace icpscape {
namespace {

// Two rows: r = (3, -2), J = (1 2 3 4 5 6 ; 0 1 0 -1 0 2). Then |r|^2 = 13,
// J^T r = (3, 4, 9, 14, 15, 14).
struct TwoRows {
  Vec<double, 2> r{3, -2};
  Mat<double, 2, 6> J;
  TwoRows() { J << 1, 2, 3, 4, 5, 6, 0, 1, 0, -1, 0, 2; }
};

const Vec6 kGradient = (Vec6() << 3, 4, 9, 14, 15, 14).finished();

Mat6 HessianByHand() {
  Mat6 H;
  H << 1, 2, 3, 4, 5, 6,      //
      2, 5, 6, 7, 10, 14,     //
      3, 6, 9, 12, 15, 18,    //
      4, 7, 12, 17, 20, 22,   //
      5, 10, 15, 20, 25, 30,  //
      6, 14, 18, 22, 30, 40;
  return H;
}

void ExpectSums(const NormalEquations& sums, double cost, double factor, long n) {
  EXPECT_DOUBLE_EQ(sums.cost, cost);
  EXPECT_LE((sums.gradient - factor * kGradient).norm(), 1e-12);
  EXPECT_LE((sums.Hessian() - factor * HessianByHand()).norm(), 1e-12);
  EXPECT_EQ(sums.num_correspondences, n);
}

TEST(NormalEquations, TwoRowsByHand) {
  NormalEquations sums;
  sums.Add(TwoRows().r, TwoRows().J);
  ExpectSums(sums, 6.5, 1, 1);
  EXPECT_FALSE(sums.upward_loss);
}

TEST(NormalEquations, ALossGivesTheCostAndWeighsTheDerivatives) {
  NormalEquations sums;
  const double rho[3] = {7, 0.25, -0.1};
  sums.Add(TwoRows().r, TwoRows().J, rho);
  ExpectSums(sums, 3.5, 0.25, 1);
  EXPECT_FALSE(sums.upward_loss);
}

TEST(NormalEquations, ScaleMultipliesTheObjectiveButNotTheCount) {
  NormalEquations sums;
  sums.Add(TwoRows().r, TwoRows().J);
  sums.Add(TwoRows().r, TwoRows().J);
  sums.Scale(0.75);
  ExpectSums(sums, 0.75 * 13, 1.5, 2);
}

TEST(NormalEquations, SumsAddUp) {
  NormalEquations once, thrice;
  once.Add(TwoRows().r, TwoRows().J);
  for (int i = 0; i < 3; ++i) {
    thrice.Add(TwoRows().r, TwoRows().J);
  }
  once += thrice;
  ExpectSums(once, 4 * 6.5, 4, 4);
}

// One pair under rho'' > 0 is enough, wherever in the sum it stands.
TEST(NormalEquations, RememberALossThatCurvesUpwards) {
  const double upward[3] = {1, 1, 0.5}, straight[3] = {1, 1, 0};
  for (int place = 0; place < 3; ++place) {
    NormalEquations sums;
    for (int i = 0; i < 3; ++i) {
      sums.Add(TwoRows().r, TwoRows().J, i == place ? upward : straight);
    }
    EXPECT_TRUE(sums.upward_loss) << place;
    EXPECT_EQ(sums.num_correspondences, 3);
    NormalEquations before = sums, after;
    after += sums;
    before += NormalEquations();
    EXPECT_TRUE(after.upward_loss);
    EXPECT_TRUE(before.upward_loss);
    sums.Scale(0.5);
    EXPECT_TRUE(sums.upward_loss);
  }
  NormalEquations sums;
  sums.Add(TwoRows().r, TwoRows().J, straight);
  sums += sums;
  EXPECT_FALSE(sums.upward_loss);
}

}  // namespace
}  // namespace icpscape
