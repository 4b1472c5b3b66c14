// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/scenes.h"

#include <algorithm>
#include <cmath>

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/simulation/highway.h"
#include "icpscape/simulation/lidar.h"
#include "icpscape/simulation/random.h"
#include "icpscape/simulation/town.h"

namespace icpscape {
namespace {

constexpr double kRadians = M_PI / 180;

/// How KITTI's lidar moved: rotation vector (rad) and translation (m) of T(N-1 <- N) and of
/// T(N-2 <- N-1), T(i <- j) = Tr^-1 P_i^-1 P_j Tr with the official poses and calibration
/// [Geiger et al. 2012]. And how it sat on its car: `pitch` (nose down) is the slope of the path
/// from frame N-6 to N+4 in the lidar's own frame, `heading` the direction of that path (to the
/// left).
struct Motion {
  const char* scene;
  const char* paper_frame;
  double rotation[3], translation[3];
  double prior_rotation[3], prior_translation[3];
  double pitch_deg, heading_deg;
};

constexpr Motion kMotions[] = {
    {"straight_street",
     "00/1500",
     {5.135691584413753e-05, 0.0001940715900627963, 0.0008241225028515839},
     {1.31435322, 0.02064646, -0.0101395},
     {0.0002763179303600622, -0.0009216045695643616, 0.0007766962706623557},
     {1.31144424, 0.01176759, 0.00245294},
     0.516,
     0.436},
    {"right_turn",
     "00/100",
     {-0.00033035999732405403, 0.0005375544450870719, -0.04119965966768844},
     {0.43751704, -0.02845005, 0.00777175},
     {-6.93575156252691e-05, 0.0013497687745472468, -0.036472481204374026},
     {0.43670674, -0.02677174, 0.00974547},
     1.450,
     -3.473},
    {"highway",
     "01/320",
     {-0.0007655871480637818, -0.0002557897125887779, 0.0008469325497808804},
     {2.61830738, -0.00765485, 0.03059189},
     {0.00041233150736038677, -0.001408926862765835, 0.0007297762340775665},
     {2.68757836, -0.01061027, 0.03338853},
     0.636,
     -0.211},
    {"highway_overtaking",
     "01/420",
     {0.00034436125495773966, 0.0016233225635005175, -0.0006630403986544897},
     {2.63806956, -0.0166116, 0.02556612},
     {0.0007251608998821437, 9.755736202462588e-05, -0.0006355822312926646},
     {2.64156083, -0.01707594, 0.02867882},
     0.607,
     -0.301},
};

const Motion& FindMotion(const std::string& scene) {
  for (const Motion& motion : kMotions) {
    if (scene == motion.scene) {
      return motion;
    }
  }
  throw UsageError("scene " + scene + ": no such scene; expected one of " + Join(SceneNames()) +
                   ".");
}

SE3d FromVectors(const double (&rotation)[3], const double (&translation)[3]) {
  Vec6 xi = Vec6::Zero();
  xi.head<3>() = Vec3(rotation[0], rotation[1], rotation[2]);
  return SE3d(SE3d::Exp(xi).R(), Vec3(translation[0], translation[1], translation[2]));
}

/// The lidar above the world's origin on a road of that height and slope across (up to the left),
/// its path along x.
SE3d OnRoad(double road_height_m, double slope_across, double heading_deg, double pitch_deg) {
  const Eigen::AngleAxisd roll(std::atan(slope_across), Vec3::UnitX());
  const Eigen::AngleAxisd yaw(-heading_deg * kRadians, Vec3::UnitZ());
  const Eigen::AngleAxisd pitch(pitch_deg * kRadians, Vec3::UnitY());
  return SE3d((roll * yaw * pitch).toRotationMatrix(), Vec3(0, 0, road_height_m + kLidarHeightM));
}

/// Distance of the lidar's car from the centre of its street: the middle of the right lane, less a
/// little to keep off parked cars.
constexpr double kLaneOffsetM = 1.25;

/// A street along x with the lidar's car on its right lane; a crossing 55 m ahead, where the car of
/// 00/1500 turns, and side roads left and right.
StreetNetwork StraightStreet(std::uint64_t key) {
  const double y = kLaneOffsetM;
  return StreetNetwork({{{Vec2(-115, y), Vec2(115, y)}},
                        {{Vec2(55, y - 60), Vec2(55, y + 60)}},
                        {{Vec2(-34, y), Vec2(-40, y + 70)}},
                        {{Vec2(19, y), Vec2(22, y - 70)}}},
                       key);
}

/// The crossing of 00/100: the poses come along one street and leave along the other, 90 degrees
/// to the right; in the frame of N - 1.
StreetNetwork RightTurn(std::uint64_t key) {
  const auto street = [](const Vec2& through, double direction_deg, double back, double on) {
    const Vec2 along(std::cos(direction_deg * kRadians), std::sin(direction_deg * kRadians));
    const Vec2 centre = through + kLaneOffsetM * Vec2(-along.y(), along.x());
    return Street{{centre - back * along, centre + on * along}};
  };
  return StreetNetwork(
      {street(Vec2(-13.9, -3.1), 13.9, 90, 110), street(Vec2(10.4, -23.5), -75.6, 100, 90)}, key);
}

/// The path of 00/100 from 25 frames before to 55 after, every 10th, in the frame of N - 1 (m).
std::vector<Vec2> RightTurnRoute() {
  return {{-13.9, -3.1}, {-7.1, -1.3}, {-1.8, -0.1}, {0.4, 0.0},   {2.4, -0.4},
          {5.3, -2.8},   {6.9, -6.4},  {8.0, -11.2}, {9.2, -17.7}, {11.0, -25.5}};
}

}  // namespace

std::vector<std::string> SceneNames() {
  std::vector<std::string> names;
  for (const Motion& motion : kMotions) {
    names.emplace_back(motion.scene);
  }
  return names;
}

void CheckSceneName(const std::string& name) { FindMotion(name); }

Scene MakeScene(const std::string& name, std::uint64_t seed) {
  const Motion& motion = FindMotion(name);
  const std::uint64_t key = MixKeys(seed, 1);
  Scene scene;
  scene.paper_frame = motion.paper_frame;
  SE3d T_world_target;
  if (name == "straight_street") {
    const StreetNetwork streets = StraightStreet(key);
    scene.world = MakeTown(streets, {Vec2(-100, 0), Vec2(100, 0)}, key);
    T_world_target =
        OnRoad(streets.RoadHeight(Vec2(0, 0)), 0.025, motion.heading_deg, motion.pitch_deg);
  } else if (name == "right_turn") {
    const StreetNetwork streets = RightTurn(key);
    scene.world = MakeTown(streets, RightTurnRoute(), key);
    T_world_target = OnRoad(streets.RoadHeight(Vec2(0, 0)), 0, 0, motion.pitch_deg);
  } else {
    scene.world = MakeHighway(key);
    if (name == "highway_overtaking") {
      AddTraffic(motion.translation[0] / kScanPeriodS, key, &scene.world);
    }
    T_world_target = OnRoad(0, kHighwayCrossfall, motion.heading_deg, motion.pitch_deg);
  }
  scene.T_world_lidar[0] =
      T_world_target * FromVectors(motion.prior_rotation, motion.prior_translation).Inverse();
  scene.T_world_lidar[1] = T_world_target;
  scene.T_world_lidar[2] = T_world_target * FromVectors(motion.rotation, motion.translation);
  return scene;
}

}  // namespace icpscape
