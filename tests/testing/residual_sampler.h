// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_TESTING_RESIDUAL_SAMPLER_H_
#define ICPSCAPE_TESTS_TESTING_RESIDUAL_SAMPLER_H_

#include <random>
#include <type_traits>

#include "icpscape/residuals/correspondence.h"
#include "icpscape/residuals/lie.h"

namespace icpscape {

/// Random pairs and poses of the size that lidars see; seeded.
class ResidualSampler {
 public:
  explicit ResidualSampler(unsigned seed) : engine_(seed) {}

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 Point(double size) {
    return {Uniform(-size, size), Uniform(-size, size), Uniform(-size, size)};
  }
  Vec3 UnitVector() {
    std::normal_distribution<double> normal;
    return Vec3(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  SE3d Pose(double translation_m, double rotation_rad) {
    Vec6 xi;
    xi << rotation_rad * UnitVector(), Point(translation_m);
    const SE3d T = SE3d::Exp(xi);
    return SE3d(T.R(), xi.tail<3>());
  }
  /// A pair that is about `distance_m` apart at T, and was matched at another pose. Line and patch
  /// pass through the match: at distance 0 every metric is at a perfect fit.
  Correspondence Pair(const SE3d& T, double distance_m) {
    Correspondence pair;
    const Vec3 p_source = Point(40);
    const Vec3 q_target = T * p_source + Point(distance_m);
    ForEachQuantity<double>([&](auto row) {
      using Row = decltype(row);
      const Vec3& point = Row::kInSourceFrame ? p_source : q_target;
      pair.*Row::kMember = Sample(typename Row::Kind(), point, T);
    });
    return pair;
  }

 private:
  static Vec3 Sample(kind::Point, const Vec3& point, const SE3d& /*T*/) { return point; }
  Vec3 Sample(kind::Direction, const Vec3& /*point*/, const SE3d& /*T*/) { return UnitVector(); }
  /// A covariance with deviations of 0.1 to 1 m.
  Mat3 Sample(kind::Matrix, const Vec3& /*point*/, const SE3d& /*T*/) {
    const Vec3 deviations(Uniform(0.1, 1), Uniform(0.1, 1), Uniform(0.1, 1));
    const Mat3 R = Pose(0, Uniform(0, 3)).R();
    return R * deviations.cwiseAbs2().asDiagonal() * R.transpose();
  }
  static Mat3 Sample(kind::Rotation, const Vec3& /*point*/, const SE3d& T) {
    return T.R() * SE3d::Exp((Vec6() << 0.1, -0.2, 0.3, 0, 0, 0).finished()).R();
  }
  static double Sample(kind::Scalar, const Vec3& /*point*/, const SE3d& /*T*/) { return 0.25; }

  std::mt19937 engine_;
};

/// The pair seen from other frames: p' = G_source p, q' = G_target q, and all else with them.
inline Correspondence ChangeFrames(const Correspondence& pair, const SE3d& G_source,
                                   const SE3d& G_target) {
  return MapQuantities<double>(pair, ~0U, [&](auto row, const auto& value) {
    using Row = decltype(row);
    if constexpr (std::is_same_v<typename Row::Kind, kind::Rotation>) {
      return (G_target.R() * value * G_source.R().transpose()).eval();
    } else {
      const SE3d& G = Row::kInSourceFrame ? G_source : G_target;
      return Row::Kind::template InFrame<double>(G, value);
    }
  });
}

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_TESTING_RESIDUAL_SAMPLER_H_
