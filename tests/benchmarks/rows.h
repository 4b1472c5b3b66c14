// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_ROWS_H_
#define ICPSCAPE_TESTS_BENCHMARKS_ROWS_H_

#include <string>

#include "icpscape/simd/level.h"
#include "tests/benchmarks/benchmark_pair.h"

namespace icpscape {

// What one table of ratios consists of: each function registers its comparisons over the pair,
// which must outlive the run.

void RegisterNeighborSearch(const BenchmarkPair& pair, int rounds);
void RegisterNormals(const BenchmarkPair& pair, int rounds);
void RegisterVoxelFilter(const BenchmarkPair& pair, int rounds);
void RegisterLandscape(const BenchmarkPair& pair, int rounds);
void RegisterClosedLoop(const BenchmarkPair& pair, int rounds);

/// For rows that are main ones only at AVX2 and above.
inline bool FromAvx2() { return ActiveSimdLevel() != SimdLevel::kBaseline; }

/// "t1", for names, and "1 thread", for people.
inline std::string ThreadsName(int threads) { return "t" + std::to_string(threads); }
inline std::string ThreadsTitle(int threads) {
  return std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_ROWS_H_
