// SPDX-License-Identifier: BSD-3-Clause
// Registers two clouds of your own.
#include <cstdio>

#include <icpscape/api/register.h>
#include "corner.h"

int main() {
  using namespace icpscape;
  const Corner corner;

  // One call, with the defaults of icpscape-register: point-to-plane from the identity.
  const RegisterResult plain = Register(corner.source, corner.target);
  std::printf("%s\n", plain.message.c_str());

  // The same with options: another metric, pairs up to 1 m, a loss, a start and an observer.
  RegisterOptions options;
  options.metrics = {"symmetric"};
  options.objective.matching.max_distance_m = 1;
  options.T_initial = SE3d(Mat3::Identity(), Vec3(0.1, 0, 0));
  options.threads = 2;
  options.minimizer.observer = [](const Observation& seen) {  // Every iterate.
    std::printf("cost %g, n %ld, |gradient| %g\n", seen.iterate.cost, seen.iterate.n,
                seen.evaluation.sums.gradient.norm());
    return true;  // False would end it.
  };
  const RegisterResult result = Register(corner.source, corner.target, options);

  // What a result is: a pose, why the search ended, and how well the pairs fit there.
  const double off = (corner.T_truth.Inverse() * result.T_target_source).Log().norm();
  std::printf("%s: rmse %g m over %ld pairs; off the truth by %g\n", NameOf(result.termination),
              result.rmse, result.num_pairs, off);
  return plain.Usable() && result.Usable() && off < 0.005 ? 0 : 1;
}
