// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/edge_to_line.h"

#include "icpscape/testing/residual_test_suite.h"

namespace icpscape {
namespace {

// Along the line, and about the point.
std::vector<Vec6> LineNullSpace(const EdgeToLine& line, const SE3d& T) {
  std::vector<Vec6> twists = RotationsAbout(line.p_source);
  twists.push_back(Slide(T.R().transpose() * line.d_line));
  return twists;
}

}  // namespace

template <>
struct ResidualProperties<EdgeToLine> : InvariantAndSmooth {
  static std::vector<Vec6> NullSpace(const EdgeToLine& metric, const SE3d& T) {
    return LineNullSpace(metric, T);
  }
};

template <>
struct ResidualProperties<EdgeToLineDistance> {
  static constexpr bool kInvariantToTargetFrame = true;
  // On the line the distance has a kink; near it curvature beats the tolerance of
  // central differences.
  static bool IsSmoothAt(const EdgeToLineDistance& metric, const SE3d& T) {
    return metric.Residual(T)[0] > 0.2;
  }
  // The distance is blind to the way round the line as well.
  static std::vector<Vec6> NullSpace(const EdgeToLineDistance& metric, const SE3d& T) {
    std::vector<Vec6> twists = LineNullSpace(metric.line, T);
    const Vec3 e = T * metric.line.p_source - metric.line.a_line;
    twists.push_back(Slide(T.R().transpose() * metric.line.d_line.cross(e)));
    return twists;
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(EdgeToLine, ResidualTest, EdgeToLine);
INSTANTIATE_TYPED_TEST_SUITE_P(EdgeToLineDistance, ResidualTest, EdgeToLineDistance);

TEST(EdgeToLine, KnownValues) {
  // A pole along z through (1, 1, 0); the point (4, 5, 7) is (3, 4) off it: 5 m.
  Correspondence c;
  c.p_source = {4, 5, 7};
  c.a_line = {1, 1, 0};
  c.d_line = {0, 0, 1};
  const EdgeToLine metric = EdgeToLine::From(c);
  EXPECT_EQ(metric.Residual(SE3d()), Vec3(-4, 3, 0));
  EXPECT_EQ(EdgeToLineDistance::From(c).Residual(SE3d())[0], 5);
  // Up along the pole nothing changes; 3 m back in x leaves 4 m.
  EXPECT_EQ(metric.Residual(SE3d(Mat3::Identity(), Vec3(0, 0, 9))), Vec3(-4, 3, 0));
  EXPECT_EQ(EdgeToLineDistance::From(c).Residual(SE3d(Mat3::Identity(), Vec3(-3, 0, 0)))[0], 4);
}

// The paper writes the distance with two virtual points of the line: |(Tp-q_j) x (Tp-q_k)| over
// |q_j - q_k|, wherever on the line they are.
TEST(EdgeToLine, EqualsThePrintedQuotient) {
  ResidualSampler sampler(1);
  for (int i = 0; i < 1000; ++i) {
    const SE3d T = sampler.Pose(3, 1);
    const Correspondence c = sampler.Pair(T, 1);
    const Vec3 q_j = c.a_line + sampler.Uniform(0.1, 3) * c.d_line;
    const Vec3 q_k = c.a_line - sampler.Uniform(0.1, 3) * c.d_line;
    const Vec3 p = T * c.p_source;
    const double printed = (p - q_j).cross(p - q_k).norm() / (q_j - q_k).norm();
    EXPECT_NEAR(EdgeToLine::From(c).Residual(T).norm(), printed, 1e-12);
    EXPECT_NEAR(EdgeToLineDistance::From(c).Residual(T)[0], printed, 1e-12);
  }
}

TEST(EdgeToLine, TheScalarIsGuardedOnTheLine) {
  Correspondence c;
  c.p_source = c.a_line = {1, 2, 3};
  c.d_line = Vec3::UnitX();
  EXPECT_EQ(EdgeToLineDistance::From(c).Residual(SE3d())[0], 0);
  EXPECT_EQ(EdgeToLineDistance::From(c).Jacobian(SE3d()).norm(), 0);
  // And so is its automatic derivative, which a plain root would make NaN.
  using Jet = ceres::Jet<double, 6>;
  Vec<Jet, 6> xi;
  for (int i = 0; i < 6; ++i) {
    xi[i] = Jet(0.0, i);
  }
  EXPECT_EQ(EdgeToLineDistance::From(c).Residual(SE3<Jet>::Exp(xi))[0].v.norm(), 0);
}

}  // namespace icpscape
