// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_BENCHMARK_PAIR_H_
#define ICPSCAPE_TESTS_BENCHMARKS_BENCHMARK_PAIR_H_

#include <optional>
#include <string>
#include <vector>

#include "apps/flags/pair.h"

namespace icpscape {

/// A pair of scans with normals, features and a ground truth, for us and for the peers.
struct BenchmarkPair {
  std::string title;
  PointCloud source, target;
  Features features;  ///< Of the source.
  std::optional<SE3d> T_ground_truth;
};

/// The pair of the flags, prepared for these metrics.
inline BenchmarkPair LoadPair(const std::vector<std::string>& metrics, Manifest* manifest) {
  ScanPair pair = ReadPair(manifest);
  const PreparedPair scans = PrepareFromFlags(metrics, &pair, manifest);
  return {pair.title, scans.source.cloud(), scans.target.cloud(),
          scans.source.features().value_or(Features()), pair.T_ground_truth};
}

/// As a registration takes it, without any search yet: those are part of what is measured.
inline PreparedPair Prepared(const BenchmarkPair& pair, int threads) {
  return {PreparedScan(SearchableCloud(pair.source, threads), pair.features),
          PreparedScan(SearchableCloud(pair.target, threads))};
}

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_BENCHMARK_PAIR_H_
