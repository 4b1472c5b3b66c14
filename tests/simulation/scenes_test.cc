// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/scenes.h"
#include "icpscape/neighbors/neighbor_search.h"
#include "icpscape/simulation/simulated_sequence.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "icpscape/common/error.h"
#include "icpscape/simulation/simulator.h"

namespace icpscape {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

bool SameBytes(const PointCloud& a, const PointCloud& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.intensity, b.intensity) &&
         same(a.ring, b.ring) && same(a.label, b.label);
}

// Share of the source's points on things that stand up which have a target point near. (Road, banks
// and rails look the same from everywhere: they say nothing about the motion along them.)
double UprightShareWithin(const PointCloud& source, const PointCloud& target, const SE3d& T,
                          float distance_m) {
  const NeighborSearch search(target.View());
  int near = 0;
  int count = 0;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Label label = SemanticOf(source.label[i]);
    if (label == Label::kVegetation || label == Label::kTrunk || label == Label::kPole ||
        label == Label::kTrafficSign || label == Label::kBuilding) {
      const Vec3 p = T * source.Point(i);
      near += search.Nearest(p.cast<float>(), distance_m * distance_m).index >= 0 ? 1 : 0;
      ++count;
    }
  }
  return static_cast<double>(near) / count;
}

class EveryScene : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScene, IsAFullScanWithRingsLabelsAndTruth) {
  const ScanPair pair = SimulatePair(GetParam(), 1, LidarOptions(), 2);
  for (const PointCloud* cloud : {&pair.source, &pair.target}) {
    EXPECT_GT(cloud->size(), 90000U);
    EXPECT_LT(cloud->size(), 64U * 2007U);
    ASSERT_EQ(cloud->ring.size(), cloud->size());
    ASSERT_EQ(cloud->label.size(), cloud->size());
    EXPECT_TRUE(std::is_sorted(cloud->ring.begin(), cloud->ring.end()));
    EXPECT_EQ(cloud->ring.front(), 0);
    EXPECT_EQ(cloud->ring.back(), 63);
    std::set<Label> labels;
    for (const std::int32_t label : cloud->label) {
      labels.insert(SemanticOf(label));
    }
    EXPECT_GE(labels.size(), 6U);
    EXPECT_TRUE(labels.count(Label::kRoad) == 1);
  }
  const double at_truth = UprightShareWithin(pair.source, pair.target, *pair.T_ground_truth, 0.1F);
  EXPECT_GT(at_truth, 0.3);
  EXPECT_GT(at_truth, 1.15 * UprightShareWithin(pair.source, pair.target, SE3d(), 0.1F));
}

// Without noise every point must lie on the world it was measured in, at the pose called the truth.
TEST_P(EveryScene, PointsLieOnTheWorldAtTheTruePose) {
  LidarOptions perfect;
  perfect.range_noise_m = perfect.ring_bias_m = perfect.dropout = 0;
  Scene scene = MakeScene(GetParam(), 3);
  const RayCaster world(scene.world.standing);
  const Simulator simulator(scene.world, perfect, 3);
  const PointCloud source = simulator.Scan(scene.T_world_lidar[2], kScanPeriodS, 2, 1);
  const SE3d T_world_source = scene.T_world_lidar[1] * scene.T_target_source();
  int checked = 0;
  for (std::size_t i = 0; i < source.size(); i += 211) {
    if (IsMoving(SemanticOf(source.label[i]))) {
      continue;
    }
    const Vec3 p = T_world_source * source.Point(i);
    const Vec3 from = T_world_source * Vec3(0, 0, RingHeight(source.ring[i]));
    const Vec3 ray = (p - from).normalized();
    RayHit hit;
    ASSERT_TRUE(world.Cast(p - 0.05 * ray, ray, 1, &hit));
    EXPECT_NEAR(hit.range_m, 0.05, 2e-3) << i;
    ++checked;
  }
  EXPECT_GT(checked, 300);
}

TEST_P(EveryScene, SameSeedSameBytesForAnyThreads) {
  const ScanPair one = SimulatePair(GetParam(), 5, LidarOptions(), 1);
  const ScanPair two = SimulatePair(GetParam(), 5, LidarOptions(), 2);
  const ScanPair other = SimulatePair(GetParam(), 6, LidarOptions(), 2);
  EXPECT_TRUE(SameBytes(one.source, two.source));
  EXPECT_TRUE(SameBytes(one.target, two.target));
  EXPECT_FALSE(SameBytes(one.source, other.source));
  EXPECT_FALSE(SameBytes(one.source, one.target));
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, ::testing::ValuesIn(SceneNames()),
                         [](const auto& scene) { return scene.param; });

TEST(Scenes, AreThePapersFour) {
  EXPECT_THAT(SceneNames(),
              ElementsAre("straight_street", "right_turn", "highway", "highway_overtaking"));
}

// Length and yaw of KITTI's motion at the paper's frames and the frames before, from the pose
// files.
TEST(Scenes, MoveAsKittiDid) {
  struct Expected {
    double length_m, yaw_deg, prior_length_m, prior_yaw_deg;
  };
  const std::map<std::string, Expected> expected = {
      {"straight_street", {1.3146, 0.047, 1.3115, 0.045}},
      {"right_turn", {0.4385, -2.361, 0.4376, -2.090}},
      {"highway", {2.6185, 0.049, 2.6878, 0.042}},
      {"highway_overtaking", {2.6382, -0.038, 2.6418, -0.036}}};
  for (const auto& [name, motion] : expected) {
    const Scene scene = MakeScene(name, 1);
    const SE3d T_predicted = scene.T_world_lidar[0].Inverse() * scene.T_world_lidar[1];
    constexpr double kDegrees = 180 / M_PI;
    EXPECT_NEAR(scene.T_target_source().t().norm(), motion.length_m, 1e-4) << name;
    EXPECT_NEAR(scene.T_target_source().LogRotation().z() * kDegrees, motion.yaw_deg, 1e-3);
    EXPECT_NEAR(T_predicted.t().norm(), motion.prior_length_m, 1e-4) << name;
    EXPECT_NEAR(T_predicted.LogRotation().z() * kDegrees, motion.prior_yaw_deg, 1e-3);
    EXPECT_NEAR(scene.T_world_lidar[1].t().z(), 1.73, 0.15) << name;
  }
}

TEST(Scenes, TrafficMovesAsStated) {
  LidarOptions perfect;
  perfect.range_noise_m = perfect.ring_bias_m = perfect.dropout = 0;
  Scene scene = MakeScene("highway_overtaking", 1);
  const Simulator simulator(scene.world, perfect, 1);
  std::map<Label, double> rear[2];
  std::map<Label, int> count;
  for (int k = 0; k < 2; ++k) {
    const SE3d& T = scene.T_world_lidar[static_cast<std::size_t>(k + 1)];
    const PointCloud cloud = simulator.Scan(T, k * kScanPeriodS, k, 2);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Label label = SemanticOf(cloud.label[i]);
      if (IsMoving(label)) {
        const double x = (T * cloud.Point(i)).x();
        const auto [at, first] = rear[k].emplace(label, x);
        at->second = std::min(at->second, x);
        ++count[label];
      }
    }
  }
  EXPECT_GT(count[Label::kMovingCar], 2000);
  EXPECT_GT(count[Label::kMovingTruck], 2000);
  // The car: 26.38 m/s of the lidar's and 6 more, in a tenth of a second. The lorry: 25 m/s.
  EXPECT_NEAR(rear[1][Label::kMovingCar] - rear[0][Label::kMovingCar], 3.238, 0.1);
  EXPECT_NEAR(rear[1][Label::kMovingTruck] - rear[0][Label::kMovingTruck], 2.5, 0.1);
  EXPECT_TRUE(MakeScene("highway", 1).world.moving.empty());
}

TEST(Scenes, UnknownNameIsAnsweredWithTheKnown) {
  try {
    CheckSceneName("motorway");
    FAIL() << "no error";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("motorway"));
    EXPECT_THAT(error.what(),
                HasSubstr("straight_street, right_turn, highway, highway_overtaking"));
  }
}

}  // namespace
}  // namespace icpscape
