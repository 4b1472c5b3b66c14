// SPDX-License-Identifier: BSD-3-Clause
// The same two scans, told in other frames: turned at random, hundreds of metres from the origins,
// with the sensors moved along.
#include <gtest/gtest.h>

#include "icpscape/testing/residual_sampler.h"
#include "tests/invariance/pairs.h"

namespace icpscape {
namespace {

using testing_support::Apart;
using testing_support::Curves;
using testing_support::ExpectEqualCurves;
using testing_support::Registered;
using testing_support::SimulatedTurn;

// A frame that is turned by 0.5 to 2.5 rad, and whose origin is 300 to 500 m away.
SE3d RandomFrame(ResidualSampler* sampler) {
  Vec6 xi;
  xi << sampler->Uniform(0.5, 2.5) * sampler->UnitVector(), Vec3::Zero();
  return SE3d(SE3d::Exp(xi).R(), sampler->Uniform(100, 250) * sampler->UnitVector());
}

struct Frames {
  SE3d source, target;

  ScanPair Of(const ScanPair& pair) const {
    ScanPair moved = pair;
    moved.source = pair.source.Transformed(source);
    moved.target = pair.target.Transformed(target);
    return moved;
  }
  SE3d Of(const SE3d& T_target_source) const { return target * T_target_source * source.Inverse(); }
};

// From half way on, so that the loop has something to do. (The symmetric metric as printed adds up
// normals of two frames: its value depends on how these are turned.)
void ExpectConjugatedPoses(const ScanPair& pair, unsigned seed) {
  ResidualSampler sampler(seed);
  const SE3d T_initial = SE3d::Exp(0.5 * pair.T_ground_truth->Log());
  for (const char* metric : {"point_to_point", "point_to_plane", "symmetric_rotated"}) {
    const Frames frames = {RandomFrame(&sampler), RandomFrame(&sampler)};
    const ScanPair far = frames.Of(pair);
    const SE3d T = Registered(pair.source, pair.target, metric, T_initial);
    const SE3d T_far = Registered(far.source, far.target, metric, frames.Of(T_initial));
    const Displacement apart = Apart(far.source, frames.Of(T), T_far);
    EXPECT_LT(apart.m, 1e-4) << metric;
    EXPECT_LT(apart.rad, 1e-4) << metric;
    EXPECT_GT(Apart(pair.source, T_initial, T).m, 0.1) << metric;
  }
}

void ExpectEqualLandscapes(const ScanPair& pair, unsigned seed) {
  ResidualSampler sampler(seed);
  const SE3d T_0, T_1 = *pair.T_ground_truth;
  const Frames frames = {RandomFrame(&sampler), RandomFrame(&sampler)};
  const ScanPair far = frames.Of(pair);
  for (const auto& [metrics, share] :
       {std::pair(std::vector<std::string>{"point_to_point"}, 1e-6),
        std::pair(std::vector<std::string>{"point_to_plane", "symmetric_rotated", "two_plane"},
                  1e-4)}) {
    ExpectEqualCurves(Curves(pair.source, pair.target, metrics, T_0, T_1, PathKind::kGeodesic),
                      Curves(far.source, far.target, metrics, frames.Of(T_0), frames.Of(T_1),
                             PathKind::kGeodesic),
                      share);
  }
}

TEST(Origin, DoesNotMatterToAPose) { ExpectConjugatedPoses(SimulatedTurn(), 1); }

TEST(Origin, DoesNotMatterToAGeodesic) { ExpectEqualLandscapes(SimulatedTurn(), 2); }

TEST(Origin, DoesNotMatterToARealPose) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  ExpectConjugatedPoses(testing_support::KittiTurn(), 3);
}

TEST(Origin, DoesNotMatterToARealGeodesic) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  ExpectEqualLandscapes(testing_support::KittiTurn(), 4);
}

// lerp_slerp and the bicycle are paths of the sensor: the curves are the same where the clouds say
// where it is, and others where they do not.
TEST(Origin, DoesNotMatterToAPathOfTheSensor) {
  const ScanPair& pair = SimulatedTurn();
  const Frames frames = {SE3d(Mat3::Identity(), Vec3(300, -200, 10)),
                         SE3d(Mat3::Identity(), Vec3(-150, 250, 30))};
  ScanPair far = frames.Of(pair);
  const SE3d T_0, T_1 = *pair.T_ground_truth;
  const auto curves_of_far = [&](const char* metric, PathKind path) {
    return Curves(far.source, far.target, {metric}, frames.Of(T_0), frames.Of(T_1), path);
  };
  for (const PathKind path : {PathKind::kLerpSlerp, PathKind::kBicycle}) {
    for (const auto& [metric, share] :
         {std::pair("point_to_point", 1e-6), std::pair("symmetric", 1e-4)}) {
      ExpectEqualCurves(Curves(pair.source, pair.target, {metric}, T_0, T_1, path),
                        curves_of_far(metric, path), share);
    }
  }
  const auto rmse_of_far = [&] {
    return curves_of_far("point_to_point", PathKind::kLerpSlerp)[0].points[0].rmse;
  };
  const double rmse = rmse_of_far();
  far.source.sensor.setZero();
  EXPECT_GT(std::abs(rmse_of_far() / rmse - 1), 0.01);
}

}  // namespace
}  // namespace icpscape
