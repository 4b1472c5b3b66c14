// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_SIMULATED_SEQUENCE_H_
#define ICPSCAPE_SRC_SIMULATION_SIMULATED_SEQUENCE_H_

#include <cstdint>
#include <string>

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/simulation/lidar.h"

namespace icpscape {

/// The drive of 228 m through a town; see TownRoute.
inline constexpr char kTown[] = "town";

/// The scans of one of SceneNames(), three of them, or of the drive through the town; with the true
/// poses. Scans are simulated when they are read, on at most `threads` threads, and do not depend
/// on which are read or in what order. Throws UsageError for an unknown scene, or where no lidar
/// can have those options.
ScanSequence SimulatedSequence(const std::string& scene, std::uint64_t seed,
                               const LidarOptions& lidar, int threads);

/// The pair of one of the paper's scenes: scan 2 to scan 1.
ScanPair SimulatePair(const std::string& scene, std::uint64_t seed, const LidarOptions& lidar,
                      int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_SIMULATED_SEQUENCE_H_
