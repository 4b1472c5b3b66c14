// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/point_to_plane.h"

#include "icpscape/testing/residual_test_suite.h"

namespace icpscape {

template <>
struct ResidualProperties<PointToPlane> : InvariantAndSmooth {
  static std::vector<Vec6> NullSpace(const PointToPlane& metric, const SE3d& T) {
    return WithSlidesAcross(T.R().transpose() * metric.n_target, RotationsAbout(metric.p_source));
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(PointToPlane, ResidualTest, PointToPlane);

TEST(PointToPlane, KnownValues) {
  // The point (1, 2, 3) is 3 above the plane z = 0 whatever x and y are.
  const PointToPlane metric{{1, 2, 3}, {7, -4, 0}, {0, 0, 1}};
  EXPECT_EQ(metric.Residual(SE3d())[0], 3);
  EXPECT_EQ(metric.Residual(SE3d(Mat3::Identity(), Vec3(5, 5, -1)))[0], 2);
  // Turning about x by w lifts the point by y w, about y lowers it by x w.
  Mat<double, 1, 6> J;
  J << 2, -1, 0, 0, 0, 1;
  EXPECT_EQ(metric.Jacobian(SE3d()), J);
}

TEST(PointToPlane, IsTheTextbookMetricForAnObliquePlane) {
  // The plane x + y + z = 3 with unit normal; the point (2, 2, 2) is 3 / sqrt(3) off it. (An
  // element-wise product instead of the dot product would give another value.)
  const PointToPlane metric{{2, 2, 2}, {3, 0, 0}, Vec3(1, 1, 1).normalized()};
  EXPECT_NEAR(metric.Residual(SE3d())[0], std::sqrt(3.0), 1e-15);
}

}  // namespace icpscape
