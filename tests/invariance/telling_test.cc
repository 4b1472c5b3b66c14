// SPDX-License-Identifier: BSD-3-Clause
// The same two scans, told in another way: source and target swapped, points in another order,
// another unit of length.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/invariance/pairs.h"

namespace icpscape {
namespace {

using testing_support::Apart;
using testing_support::Curves;
using testing_support::ExpectEqualCurves;
using testing_support::Registered;
using testing_support::SimulatedTurn;

const std::vector<std::string> kMetrics = {"point_to_point", "point_to_plane", "symmetric"};

SE3d HalfWay(const ScanPair& pair) { return SE3d::Exp(0.5 * pair.T_ground_truth->Log()); }

// The pairs are others: each point of the new source looks for its closest one. The poses agree
// within what the metric leaves open, a few millimetres where planes meet; points of a scan line
// hold on to the scan lines of the other scan.
void ExpectInversePoses(const ScanPair& pair) {
  ScanPair reversed = pair;
  reversed.Reverse();
  EXPECT_LT(Apart(pair.source, reversed.T_ground_truth->Inverse(), *pair.T_ground_truth).m, 1e-12);
  for (const auto& [metric, tolerance_m, tolerance_deg] :
       {std::tuple("point_to_point", 0.05, 0.1), std::tuple("point_to_plane", 0.02, 0.15),
        std::tuple("symmetric", 0.02, 0.1)}) {
    const SE3d T = Registered(pair.source, pair.target, metric, HalfWay(pair));
    const SE3d T_reversed =
        Registered(reversed.source, reversed.target, metric, HalfWay(pair).Inverse());
    const Displacement apart = Apart(pair.source, T_reversed.Inverse(), T);
    EXPECT_LT(apart.m, tolerance_m) << metric;
    EXPECT_LT(apart.rad, tolerance_deg) << metric;
  }
}

TEST(Reversing, GivesTheInverse) { ExpectInversePoses(SimulatedTurn()); }

TEST(Reversing, GivesTheInverseOfARealPose) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  ExpectInversePoses(testing_support::KittiTurn());
}

PointCloud Shuffled(const PointCloud& cloud, unsigned seed) {
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  PointCloud shuffled;
  for (const std::size_t i : order) {
    shuffled.x.push_back(cloud.x[i]);
    shuffled.y.push_back(cloud.y[i]);
    shuffled.z.push_back(cloud.z[i]);
  }
  return shuffled;
}

// Only rounding differs, by the order of sums, and which of two points at one distance is closest.
TEST(Permuting, ChangesNothing) {
  const ScanPair& pair = SimulatedTurn();
  const PointCloud source = Shuffled(pair.source, 1), target = Shuffled(pair.target, 2);
  EXPECT_NE(source.x, pair.source.x);
  ExpectEqualCurves(
      Curves(pair.source, pair.target, kMetrics, SE3d(), *pair.T_ground_truth,
             PathKind::kLerpSlerp),
      Curves(source, target, kMetrics, SE3d(), *pair.T_ground_truth, PathKind::kLerpSlerp), 1e-6);
  for (const std::string& metric : kMetrics) {
    const Displacement apart =
        Apart(source, Registered(pair.source, pair.target, metric, HalfWay(pair)),
              Registered(source, target, metric, HalfWay(pair)));
    EXPECT_LT(apart.m, 1e-4) << metric;
    EXPECT_LT(apart.rad, 1e-4) << metric;
  }
}

// In millimetres the clouds would lie far out, and have an origin taken out.
constexpr double kFeet = 1 / 0.3048;

SE3d InFeet(const SE3d& T) { return SE3d(T.R(), kFeet * T.t()); }
PointCloud InFeet(PointCloud cloud) {
  for (std::vector<float>* values : {&cloud.x, &cloud.y, &cloud.z}) {
    for (float& value : *values) {
      value *= static_cast<float>(kFeet);
    }
  }
  return cloud;
}

// Lengths in millimetres, gates and stop rules too.
TEST(Units, ScaleTheResults) {
  const ScanPair& pair = SimulatedTurn();
  const PointCloud source = InFeet(pair.source), target = InFeet(pair.target);
  const SE3d T_1 = *pair.T_ground_truth;
  for (const PathKind path : {PathKind::kLerpSlerp, PathKind::kGeodesic}) {
    for (const auto& [metric, share] :
         {std::pair("point_to_point", 1e-6), std::pair("point_to_plane", 1e-4),
          std::pair("symmetric", 1e-4)}) {
      ExpectEqualCurves(Curves(pair.source, pair.target, {metric}, SE3d(), T_1, path),
                        Curves(source, target, {metric}, SE3d(), InFeet(T_1), path), share, kFeet);
    }
  }
  for (const std::string& metric : kMetrics) {
    const SE3d T = Registered(pair.source, pair.target, metric, HalfWay(pair));
    const SE3d T_feet = Registered(source, target, metric, InFeet(HalfWay(pair)), kFeet);
    const Displacement apart = Apart(source, InFeet(T), T_feet);
    EXPECT_LT(apart.m, 1e-4 * kFeet) << metric;
    EXPECT_LT(apart.rad, 1e-4) << metric;
  }
}

}  // namespace
}  // namespace icpscape
