// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_RESIDUAL_SAMPLER_H_
#define ICPSCAPE_TESTS_SUPPORT_RESIDUAL_SAMPLER_H_

#include <random>

#include "residuals/correspondence.h"
#include "residuals/lie.h"

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
  /// A pair that is about `distance_m` apart at T.
  Correspondence Pair(const SE3d& T, double distance_m) {
    Correspondence c;
    c.p_source = Point(40);
    c.q_target = T * c.p_source + Point(distance_m);
    c.n_source = UnitVector();
    c.n_target = UnitVector();
    // Line and patch pass through the match: at distance 0 every metric is at a perfect fit.
    c.d_line = UnitVector();
    c.a_line = c.q_target;
    c.n_patch = UnitVector();
    c.q_patch = c.q_target;
    c.area_patch = 0.25;
    return c;
  }

 private:
  std::mt19937 engine_;
};

/// The pair seen from other frames: p' = G_source p, q' = G_target q, directions with them.
inline Correspondence ChangeFrames(const Correspondence& c, const SE3d& G_source,
                                   const SE3d& G_target) {
  Correspondence out = c;
  out.p_source = G_source * c.p_source;
  out.n_source = G_source.R() * c.n_source;
  out.q_target = G_target * c.q_target;
  out.n_target = G_target.R() * c.n_target;
  out.a_line = G_target * c.a_line;
  out.d_line = G_target.R() * c.d_line;
  out.q_patch = G_target * c.q_patch;
  out.n_patch = G_target.R() * c.n_patch;
  return out;
}

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_SUPPORT_RESIDUAL_SAMPLER_H_
