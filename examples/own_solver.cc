// SPDX-License-Identifier: BSD-3-Clause
// Your own Gauss-Newton on the residuals: it needs only Eigen.
#include <Eigen/Dense>
#include <cstdio>
#include <random>

#include <icpscape/residuals/normal_equations.h>
#include <icpscape/residuals/point_to_plane.h>

int main() {
  using namespace icpscape;
  const SE3d truth = SE3d::Exp((Vec6() << 0.1, -0.2, 0.3, 1, 2, 3).finished());
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3(uniform(engine), uniform(engine), uniform(engine)); };
  std::vector<PointToPlane> metrics;
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = 10 * vector();
    metrics.push_back({p, truth * p, vector().normalized()});
  }
  SE3d T;
  for (int iteration = 0; iteration < 10; ++iteration) {
    NormalEquations sums;
    for (const PointToPlane& metric : metrics) {
      Accumulate(metric, T, &sums);
    }
    T = T * SE3d::Exp(-sums.Hessian().ldlt().solve(sums.gradient));
  }
  const double error = (truth.Inverse() * T).Log().norm();
  std::printf("off the truth by %g\n", error);
  return error < 1e-12 ? 0 : 1;
}
