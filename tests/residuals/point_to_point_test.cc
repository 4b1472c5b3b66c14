// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/point_to_point.h"

#include "icpscape/testing/residual_test_suite.h"

namespace icpscape {

template <>
struct ResidualProperties<PointToPoint> : InvariantAndSmooth {
  static std::vector<Vec6> NullSpace(const PointToPoint& metric, const SE3d& /*T*/) {
    return RotationsAbout(metric.p_source);
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(PointToPoint, ResidualTest, PointToPoint);

TEST(PointToPoint, KnownValues) {
  const PointToPoint metric{{1, 2, 3}, {0, 2, 5}};
  EXPECT_EQ(metric.Residual(SE3d()), Vec3(1, 0, -2));
  // A quarter turn about z takes (1, 2, 3) to (-2, 1, 3); then the translation (10, 20, 30).
  Mat3 R;
  R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(metric.Residual(SE3d(R, Vec3(10, 20, 30))), Vec3(8, 19, 28));
  // d(R Exp(w) p)/dw = -R [p]x; at the identity -[p]x with p = (1, 2, 3).
  Mat<double, 3, 6> J;
  J << 0, 3, -2, 1, 0, 0,  //
      -3, 0, 1, 0, 1, 0,   //
      2, -1, 0, 0, 0, 1;
  EXPECT_EQ(metric.Jacobian(SE3d()), J);
}

}  // namespace icpscape
