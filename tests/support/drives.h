// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_DRIVES_H_
#define ICPSCAPE_TESTS_SUPPORT_DRIVES_H_

#include <vector>

#include "icpscape/simulation/drive.h"
#include "icpscape/simulation/simulator.h"

namespace icpscape::testing_support {

/// A short drive of a simulated lidar through a town.
struct SimulatedDrive {
  std::vector<PointCloud> scans;
  std::vector<SE3d> T_world_lidar;  ///< The truth; the world is the first scan's frame.
};

/// `count` scans, `motion` apart, by a lidar with a firing every degree.
inline SimulatedDrive SimulateDrive(const SE3d& motion, int count, bool skewed = false) {
  std::vector<SE3d> poses(1);
  for (int i = 1; i < 40; ++i) {  // The town is built along a route that is long enough for one.
    poses.push_back(poses.back() * motion);
  }
  Drive drive = MakeDrive(poses, 1);
  LidarOptions options;
  options.azimuth_step_deg = 1;
  options.skewed = skewed;
  const std::vector<LidarMotion> motions = MotionsThrough(drive.T_world_lidar);
  const Simulator simulator(std::move(drive.world), options, 1);
  SimulatedDrive result;
  for (int i = 0; i < count; ++i) {
    const LidarMotion& there = motions[static_cast<std::size_t>(i)];
    result.scans.push_back(simulator.Scan(there, 0.1 * i, i, 2));
    result.T_world_lidar.push_back(drive.T_world_lidar[0].Inverse() * there.T_world_lidar);
  }
  return result;
}

/// The same, 0.8 m apart on a bend of 1 degree a scan.
inline SimulatedDrive SimulateTownDrive(int count) {
  return SimulateDrive(SE3d::Exp((Vec6() << 0, 0, M_PI / 180, 0.8, 0, 0).finished()), count);
}

/// Eight scans, simulated once.
inline const SimulatedDrive& TownDrive() {
  static const SimulatedDrive drive = SimulateTownDrive(8);
  return drive;
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_DRIVES_H_
