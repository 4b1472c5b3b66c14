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

/// The goal of work that is measured at AVX2 and above; 0, for none, where the program was told to
/// run at the baseline.
inline double FromAvx2(double goal) { return ActiveSimdLevel() == SimdLevel::kBaseline ? 0 : goal; }

/// "t1", for names, and "1 thread", for people.
inline std::string ThreadsName(int threads) { return "t" + std::to_string(threads); }
inline std::string ThreadsTitle(int threads) {
  return std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_ROWS_H_
