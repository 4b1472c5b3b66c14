// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_PAIRS_H_
#define ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_PAIRS_H_

#include <filesystem>
#include <string>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Two scans whose motion is known, as far as the last two say.
struct AccuracyPair {
  std::string name;
  PointCloud source, target;
  SE3d T_truth;
  double truth_m = 0, truth_deg = 0;  ///< How well the truth itself is known; 0: exactly.
};

/// Scans 15 and 95 of KITTI 00 and 1 to 4 of 07, each with the one before. The truth is the
/// official pose, refined by CheckGroundTruth.
std::vector<AccuracyPair> KittiPairs(const std::filesystem::path& root, int threads);

/// source.ply, target.ply and T_target_source.txt, as small_gicp has them.
AccuracyPair SmallGicpPair(const std::filesystem::path& folder);

/// Pairs of the simulated drive through the town, 3 to 9 m and up to 30 degrees apart. Every other
/// one is turned by more than 10 degrees.
std::vector<AccuracyPair> WideTownPairs(int count, unsigned seed, int threads);

/// Two scans of that drive, one after the other.
AccuracyPair TownStep(unsigned seed, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_PAIRS_H_
