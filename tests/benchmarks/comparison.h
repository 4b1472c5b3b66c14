// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_COMPARISON_H_
#define ICPSCAPE_TESTS_BENCHMARKS_COMPARISON_H_

#include <functional>
#include <stdexcept>
#include <string>

namespace icpscape {

/// One of the two programs that are compared.
struct Side {
  std::string name;           ///< "PCL".
  std::function<void()> run;  ///< What is timed. Null: there is no such side.
  /// The share of the work that `run` does, for work too slow to be done whole; times are divided
  /// by it, and the name should say so.
  double share = 1;
};

/// Two sides that do the same work on the same data.
struct Comparison {
  std::string name;      ///< "normals/pcl/t1": for --benchmark_filter.
  std::string title;     ///< "20-neighbour normals, 1 thread": for people.
  bool is_main = false;  ///< Listed in the table of the main ratios.
  Side ours;
  Side peer;
  /// Called once after both sides have run: throws Mismatch where their answers differ.
  std::function<void()> check = nullptr;
};

struct Mismatch : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Registers the comparison with Google Benchmark. The sides run in turn, `rounds` times, and begin
/// in turn, so that both see the same machine; reported are the medians of the times ("ours_ms",
/// "peer_ms") and of the rounds' ratios ("ratio", with its quartiles), and "is_main".
void Register(const Comparison& comparison, int rounds);

/// Whether a check has failed so far.
bool AnyMismatch();

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_COMPARISON_H_
