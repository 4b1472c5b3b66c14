// SPDX-License-Identifier: BSD-3-Clause
// A metric in your own ceres::Problem, as the README shows.
#include <ceres/ceres.h>

#include <cstdio>
#include <random>

#include <icpscape/residuals/adapters/ceres.h>
#include <icpscape/residuals/point_to_plane.h>

int main() {
  using namespace icpscape;
  const SE3d truth = SE3d::Exp((Vec6() << 0.1, -0.2, 0.3, 1, 2, 3).finished());
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3(uniform(engine), uniform(engine), uniform(engine)); };
  double x[7];  // [qx qy qz qw tx ty tz]
  SE3d().ToParameters(x);
  ceres::Problem problem;
  problem.AddParameterBlock(x, 7, new SE3Manifold);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = 10 * vector();
    problem.AddResidualBlock(
        new CeresCost<PointToPlane>(PointToPlane{p, truth * p, vector().normalized()}),
        new ceres::HuberLoss(0.1), x);
  }
  ceres::Solver::Options options;
  options.function_tolerance = 1e-20;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  const double error = (truth.Inverse() * SE3d::FromParameters(x)).Log().norm();
  std::printf("off the truth by %g\n", error);
  return error < 1e-8 ? 0 : 1;
}
