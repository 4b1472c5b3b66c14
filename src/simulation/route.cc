// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/route.h"

#include <algorithm>
#include <cmath>

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/common/vehicle.h"
#include "icpscape/simulation/lidar.h"

namespace icpscape {
namespace {

struct Piece {
  double length_m;
  double curvature;  // 1/m, positive to the left.
};

constexpr double kRadius_m = 9;
constexpr double kQuarter_m = kRadius_m * M_PI / 2;
constexpr Piece kPieces[] = {
    {70, 0}, {kQuarter_m, -1 / kRadius_m}, {60, 0}, {kQuarter_m, 1 / kRadius_m}, {70, 0}};

constexpr double kStep_m = 0.01;
constexpr double kCruise_mps = 10;
constexpr double kTurn_mps = 4;
constexpr double kAcceleration = 2;

// The axle's poses every kStep_m, and how fast each may be passed.
void Trace(std::vector<SE3d>* poses, std::vector<double>* speeds) {
  SE3d T(Mat3::Identity(), Vec3::Zero());
  for (const Piece& piece : kPieces) {
    const Vec6 step = (Vec6() << 0, 0, piece.curvature * kStep_m, kStep_m, 0, 0).finished();
    for (double s = 0; s < piece.length_m; s += kStep_m) {
      poses->push_back(T);
      speeds->push_back(piece.curvature == 0 ? kCruise_mps : kTurn_mps);
      T = T * SE3d::Exp(step);
    }
  }
}

// From standstill to standstill: v^2 changes by at most 2 a ds from sample to sample.
void LimitAcceleration(std::vector<double>* speeds) {
  const auto follow = [](double before, double limit) {
    return std::min(limit, std::sqrt(before * before + 2 * kAcceleration * kStep_m));
  };
  std::vector<double>& v = *speeds;
  v.front() = v.back() = 0;
  for (std::size_t i = 1; i < v.size(); ++i) {
    v[i] = follow(v[i - 1], v[i]);
  }
  for (std::size_t i = v.size() - 1; i-- > 0;) {
    v[i] = follow(v[i + 1], v[i]);
  }
}

}  // namespace

std::vector<SE3d> TownRoute() {
  std::vector<SE3d> axle;
  std::vector<double> speeds;
  Trace(&axle, &speeds);
  LimitAcceleration(&speeds);
  const SE3d T_axle_lidar(Mat3::Identity(), Vec3(kSensorAheadOfRearAxle_m, 0, kLidarHeightM));
  std::vector<SE3d> poses = {axle[0] * T_axle_lidar};
  double time_s = 0;
  for (std::size_t i = 1; i < axle.size(); ++i) {
    time_s += 2 * kStep_m / (speeds[i - 1] + speeds[i]);
    if (time_s >= kScanPeriodS * static_cast<double>(poses.size())) {
      poses.push_back(axle[i] * T_axle_lidar);
    }
  }
  return poses;
}

}  // namespace icpscape
