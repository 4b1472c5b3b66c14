// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_ADAPTIVE_GATE_H_
#define ICPSCAPE_SRC_ODOMETRY_ADAPTIVE_GATE_H_

#include <cmath>

#include "icpscape/residuals/lie.h"

namespace icpscape {

/// The gate of a registration, from the errors of the predicted poses so far [KISS-ICP, Vizzo et
/// al. 2023, eq. 7 to 9]: 3 sigma, where sigma^2 is the mean square of
///   delta = |t| + 2 r sin(theta / 2)
/// over all frames whose delta is above kSmallest_m, (theta, t) being the error of the predicted
/// pose and r the farthest range: delta is how far it can displace a point.
class AdaptiveGate {
 public:
  static constexpr double kSmallest_m = 0.1;
  static constexpr double kFarthestRange_m = 100;

  /// The first predicted pose is assumed to be off by this.
  explicit AdaptiveGate(double initial_m) : sum_squared_(initial_m * initial_m) {}

  double MaxDistance_m() const { return 3 * std::sqrt(sum_squared_ / count_); }

  void Add(const SE3d& T_predicted, const SE3d& T_found) {
    const SE3d error = T_predicted.Inverse() * T_found;
    const double delta =
        error.t().norm() + 2 * kFarthestRange_m * std::sin(error.LogRotation().norm() / 2);
    if (delta > kSmallest_m) {
      sum_squared_ += delta * delta;
      ++count_;
    }
  }

 private:
  double sum_squared_;
  int count_ = 1;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_ADAPTIVE_GATE_H_
