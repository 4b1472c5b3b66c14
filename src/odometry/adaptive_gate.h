// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_ADAPTIVE_GATE_H_
#define ICPSCAPE_SRC_ODOMETRY_ADAPTIVE_GATE_H_

#include <algorithm>
#include <cmath>

#include "icpscape/residuals/lie.h"

namespace icpscape {

/// The gate of a registration, from the errors of the predicted poses so far [KISS-ICP, Vizzo et
/// al. 2023, eq. 7 to 9]: 3 sigma, where sigma^2 is the mean square of
///   delta = |t| + 2 r sin(theta / 2)
/// over all frames whose delta is above kSmallest_m, (theta, t) being the prediction's error and r
/// the farthest range: how far it can displace a point. Never more than five times what the
/// first prediction is taken to be off by, so that one bad scan does not open it for the next.
class AdaptiveGate {
 public:
  static constexpr double kSmallest_m = 0.1;
  static constexpr double kFarthestRange_m = 100;

  /// The first prediction is taken to be off by so much.
  explicit AdaptiveGate(double initial_m)
      : sum_squared_(initial_m * initial_m), most_m_(5 * initial_m) {}

  double MaxDistance_m() const { return std::min(3 * std::sqrt(sum_squared_ / count_), most_m_); }

  void Add(const SE3d& T_predicted, const SE3d& T_found) {
    const SE3d error = T_predicted.Inverse() * T_found;
    const double delta =
        std::min(most_m_, error.t().norm() +
                              2 * kFarthestRange_m * std::sin(error.LogRotation().norm() / 2));
    if (delta > kSmallest_m) {
      sum_squared_ += delta * delta;
      ++count_;
    }
  }

 private:
  double sum_squared_;
  double most_m_;
  int count_ = 1;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_ADAPTIVE_GATE_H_
