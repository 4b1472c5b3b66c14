// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/units.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace icpscape {
namespace {

// A lattice of 21 x 21 points, `step` apart, around (500, 0, 3).
PointCloud Lattice(double step) {
  PointCloud cloud;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) {
      testing_support::AddPoint({500 + step * i, step * j, 3}, &cloud);
    }
  }
  return cloud;
}

TEST(Units, RangeAndSpacingOfALattice) {
  const CloudScale scale = ScaleOf(Lattice(0.5));
  EXPECT_NEAR(scale.spacing_m, 0.5, 1e-6);
  // Half of the square of 10 m lies within a circle of 10 / sqrt(2 pi) = 3.99 m.
  EXPECT_NEAR(scale.range_m, 3.99, 0.3);
  EXPECT_EQ(RangeOf(Lattice(0.5)).range_m, scale.range_m);
}

TEST(Units, MillimetresAreFarAndThin) {
  EXPECT_FALSE(ScaleOf(Lattice(0.5)).LooksLikeMillimetres());
  EXPECT_TRUE(ScaleOf(Lattice(500)).LooksLikeMillimetres());
  EXPECT_FALSE((CloudScale{5000, 1}).LooksLikeMillimetres());  // An aerial survey.
}

TEST(Units, AThousandfoldIsOfRangeAndSpacing) {
  const CloudScale metres = ScaleOf(Lattice(0.5)), millimetres = ScaleOf(Lattice(500));
  EXPECT_TRUE(millimetres.IsThousandfold(metres));
  EXPECT_FALSE(metres.IsThousandfold(millimetres));
  EXPECT_FALSE(ScaleOf(Lattice(50)).IsThousandfold(metres));
  // A large map of the same density.
  EXPECT_FALSE((CloudScale{metres.range_m * 1000, metres.spacing_m}).IsThousandfold(metres));
  EXPECT_FALSE(metres.IsThousandfold({0, 0}));
}

}  // namespace
}  // namespace icpscape
