// SPDX-License-Identifier: BSD-3-Clause
// Registers two clouds and says how sure the result is, by direction.
#include <cstdio>

#include <icpscape/api/covariance.h>
#include "corner.h"

int main() {
  using namespace icpscape;
  const Corner corner;

  PairCovarianceOptions options;
  options.metrics = {"point_to_plane"};
  const CovarianceResult result = Covariance(corner.source, corner.target, options).front();

  // The 6x6 covariance of [omega; v]: rotation about x, y, z (rad), then translation (m), in the
  // frame of the source. It is absent where the pairs do not determine all six directions.
  for (const EstimatedCovariance& estimate : result.covariances) {
    if (!estimate.covariance) {
      std::printf("%s: none, %s\n", NameOf(estimate.estimator), estimate.reason.c_str());
      continue;
    }
    const Vec6 deviation = estimate.covariance->diagonal().cwiseSqrt();
    std::printf("%s: %.3g %.3g %.3g rad, %.3g %.3g %.3g m\n", NameOf(estimate.estimator),
                deviation[0], deviation[1], deviation[2], deviation[3], deviation[4], deviation[5]);
  }

  // The direction that the pairs determine worst, in [L omega; v].
  std::printf("weakest direction, eigenvalue %g:\n", result.directions.eigenvalues[0]);
  for (int i = 0; i < 6; ++i) {
    std::printf(" %.2f", result.directions.directions(i, 0));
  }
  std::printf("\n");

  // Three walls determine all of it: the error must lie within a few deviations.
  const std::optional<Mat6>& covariance = result.Of(Estimator::kSandwichClustered);
  const Vec6 error = (result.T_target_source.Inverse() * corner.T_truth).Log();
  return covariance && error.dot(covariance->inverse() * error) < 50 ? 0 : 1;
}
