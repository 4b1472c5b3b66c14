// SPDX-License-Identifier: BSD-3-Clause
// Registers two clouds through the installed library.
#include <cstdio>
#include <random>

#include "src/cloud/normals.h"
#include "src/matching/closest_point_matcher.h"
#include "src/minimizer/minimizer.h"

int main() {
  using namespace icpscape;
  const SE3d truth = SE3d::Exp((Vec6() << 0, 0, 0.02, 0.1, 0.05, 0.02).finished());
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> uniform(-5, 5);
  PointCloud target, source;
  for (int i = 0; i < 3000; ++i) {  // Three walls of a corner.
    float p[3] = {uniform(engine), uniform(engine), uniform(engine)};
    p[i % 3] = 5;
    PointCloud& cloud = i % 2 == 0 ? target : source;
    cloud.x.push_back(p[0]), cloud.y.push_back(p[1]), cloud.z.push_back(p[2]);
  }
  source = source.Transformed(truth.Inverse());
  EstimateNormals({}, 1, &target);
  const ClosestPointMatcher matcher(source, target);
  const Objective objective("point_to_plane", matcher);
  MinimizerOptions options;
  options.observer = [](const Observation& seen) {  // Every iterate; false would end the loop.
    std::printf("cost %g, n %ld, |gradient| %g\n", seen.iterate.cost, seen.iterate.n,
                seen.evaluation.sums.gradient.norm());
    return true;
  };
  const MinimizerSummary summary = Minimize(objective, SE3d(), options);
  const double error = (truth.Inverse() * summary.T_target_source()).Log().norm();
  std::printf("%s; off the truth by %g\n", summary.message.c_str(), error);
  return summary.Usable() && error < 0.02 ? 0 : 1;
}
