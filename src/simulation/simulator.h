// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_SIMULATOR_H_
#define ICPSCAPE_SRC_SIMULATION_SIMULATOR_H_

#include <cstdint>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/simulation/lidar.h"
#include "icpscape/simulation/world.h"

namespace icpscape {

/// A lidar in a world. Scans depend on the seed and their index, not on threads or order.
class Simulator {
 public:
  /// Throws UsageError where no lidar can have those options.
  Simulator(World world, const LidarOptions& options, std::uint64_t seed);

  /// The scan whose instant is `time_s`; in a skewed one vehicles move as well. `sensor` 0 is the
  /// lidar of the seed; every other number is another copy of its model, whose lasers have constant
  /// errors of their own.
  PointCloud Scan(const LidarMotion& motion, double time_s, int index, int threads,
                  std::uint64_t sensor = 0) const;

 private:
  World world_;
  LidarOptions options_;
  std::uint64_t seed_;
  RayCaster standing_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_SIMULATOR_H_
