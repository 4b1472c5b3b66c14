// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/accuracy_pairs.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <utility>

#include "icpscape/api/pair.h"
#include "icpscape/common/text.h"
#include "icpscape/io/point_files.h"
#include "icpscape/io/sequences.h"
#include "icpscape/io/transform.h"
#include "icpscape/minimizer/ground_truth_check.h"
#include "icpscape/simulation/simulated_sequence.h"

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;
// Point-to-plane and other registrations agree this well on KITTI's scans.
constexpr double kKittiTruthM = 0.01, kKittiTruthDeg = 0.1;
// By the README of small_gicp's data.
constexpr double kSmallGicpTruthM = 0.01, kSmallGicpTruthDeg = 0.3;

// Which motions of the town's drive are wide.
constexpr double kNearestM = 3, kFarthestM = 9;
constexpr double kMostTurnDeg = 30, kTurnedDeg = 10;

AccuracyPair Exact(ScanPair pair) {
  return {std::move(pair.title), std::move(pair.source), std::move(pair.target),
          *pair.T_ground_truth};
}

SE3d Refined(const ScanPair& pair, int threads) {
  PairOptions options;
  options.metrics = {"point_to_plane"};
  options.threads = threads;
  const PreparedPair scans = PrepareClouds(pair.source, pair.target, options);
  return CheckGroundTruth(*scans.source.clouds().points, *scans.target.clouds().points,
                          *pair.T_ground_truth, threads)
      .T_refined;
}

bool IsWide(const SE3d& motion, bool turned) {
  const double m = motion.t().norm();
  const double deg = motion.LogRotation().norm() * kDegrees;
  return m >= kNearestM && m <= kFarthestM && deg <= kMostTurnDeg && (!turned || deg > kTurnedDeg);
}

}  // namespace

std::vector<AccuracyPair> KittiPairs(const std::filesystem::path& root, int threads) {
  std::vector<AccuracyPair> pairs;
  const std::pair<const char*, std::vector<int>> frames[] = {{"00", {15, 95}},
                                                             {"07", {1, 2, 3, 4}}};
  for (const auto& [sequence, sources] : frames) {
    const ScanSequence scans = OpenKittiSequence(root, sequence);
    for (const int source : sources) {
      AccuracyPair pair = Exact(scans.Pair(source, source - 1));
      pair.T_truth = Refined(scans.Pair(source, source - 1), threads);
      pair.truth_m = kKittiTruthM;
      pair.truth_deg = kKittiTruthDeg;
      pair.name = "KITTI " + std::string(sequence) + "/" + std::to_string(source);
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

AccuracyPair SmallGicpPair(const std::filesystem::path& folder) {
  DroppedPoints dropped;
  return {"small_gicp",
          ReadPointFile(folder / "source.ply", &dropped),
          ReadPointFile(folder / "target.ply", &dropped),
          ReadTransform(folder / "T_target_source.txt"),
          kSmallGicpTruthM,
          kSmallGicpTruthDeg};
}

std::vector<AccuracyPair> WideTownPairs(int count, unsigned seed, int threads) {
  const ScanSequence town = SimulatedSequence(kTown, seed, LidarOptions(), threads);
  std::mt19937 engine(seed);
  const auto draw = [&] { return static_cast<int>(engine() % town.scans.size()); };
  std::vector<AccuracyPair> pairs;
  while (static_cast<int>(pairs.size()) < count) {
    const int target = draw();
    const int source = draw();
    if (source > target && IsWide(*town.Motion(target, source), pairs.size() % 2 == 0)) {
      pairs.push_back(Exact(town.Pair(source, target)));
    }
  }
  return pairs;
}

AccuracyPair TownStep(unsigned seed, int threads) {
  const ScanSequence town = SimulatedSequence(kTown, seed, LidarOptions(), threads);
  const int middle = static_cast<int>(town.scans.size() / 2);
  AccuracyPair pair = Exact(town.Pair(middle, middle - 1));
  pair.name = "the town";
  return pair;
}

}  // namespace icpscape
