// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_ODOMETRY_TRAJECTORIES_H_
#define ICPSCAPE_TESTS_ODOMETRY_TRAJECTORIES_H_

#include <cmath>
#include <random>
#include <vector>

#include "icpscape/residuals/lie.h"

namespace icpscape::testing_support {

inline constexpr double kDegree = M_PI / 180;

inline SE3d Yaw(double angle_rad) {
  return SE3d::Exp((Vec6() << 0, 0, angle_rad, 0, 0, 0).finished());
}
inline SE3d Forward(double length_m) { return SE3d(Mat3::Identity(), Vec3(length_m, 0, 0)); }

/// `count` poses, each the one before moved by `motion`.
inline std::vector<SE3d> Drive(const SE3d& motion, int count) {
  std::vector<SE3d> poses = {SE3d()};
  while (static_cast<int>(poses.size()) < count) {
    poses.push_back(poses.back() * motion);
  }
  return poses;
}

/// A long drive with curves, slopes and all speeds up to 20 m/s.
inline std::vector<SE3d> WindingDrive(int count) {
  std::vector<SE3d> poses = {SE3d()};
  for (int i = 1; i < count; ++i) {
    const double s = i / 400.0;
    Vec6 twist;
    twist << 0.002 * std::sin(7 * s), 0.003 * std::cos(5 * s), 0.02 * std::sin(3 * s),
        1 + std::sin(2 * s), 0, 0;
    poses.push_back(poses.back() * SE3d::Exp(twist));
  }
  return poses;
}

/// An odometry that errs at random in every step.
inline std::vector<SE3d> Perturbed(const std::vector<SE3d>& truth, unsigned seed) {
  std::mt19937 engine(seed);
  const auto noise = [&] { return static_cast<double>(engine()) / 2147483648.0 - 1; };
  std::vector<SE3d> poses = {truth[0]};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    Vec6 xi;
    for (int k = 0; k < 6; ++k) {
      xi(k) = (k < 3 ? 1e-3 : 2e-2) * noise();
    }
    poses.push_back(poses.back() * (truth[i - 1].Inverse() * truth[i]) * SE3d::Exp(xi));
  }
  return poses;
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_ODOMETRY_TRAJECTORIES_H_
