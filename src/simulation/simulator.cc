// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/simulator.h"

#include <optional>

#include "icpscape/simulation/random.h"

namespace icpscape {
namespace {

LidarOptions Checked(const LidarOptions& options) {
  options.Check();
  return options;
}

}  // namespace

Simulator::Simulator(World world, const LidarOptions& options, std::uint64_t seed)
    : world_(std::move(world)),
      options_(Checked(options)),
      seed_(seed),
      standing_(std::move(world_.standing)) {}

PointCloud Simulator::Scan(const LidarMotion& motion, double time_s, int index, int threads,
                           std::uint64_t sensor) const {
  std::optional<RayCaster> moving;
  if (!world_.moving.empty()) {
    const double half_s = options_.skewed ? kScanPeriodS / 2 : 0;
    moving.emplace(world_.MovingAt(time_s - half_s), options_.skewed
                                                         ? world_.MovingAt(time_s + half_s).vertices
                                                         : std::vector<std::array<float, 3>>());
  }
  return ScanWorld(standing_, moving ? &*moving : nullptr, motion, options_,
                   sensor == 0 ? MixKeys(seed_, 101) : MixKeys(seed_, 101, sensor),
                   MixKeys(seed_, 102, index), threads);
}

}  // namespace icpscape
