// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_TABLE_H_
#define ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_TABLE_H_

#include <cstddef>
#include <string>
#include <vector>

namespace icpscape {

/// How far from the truth one registration ended: metres of the source's centroid, and degrees.
struct Attempt {
  double m = 0, deg = 0, seconds = 0;
  bool Succeeded() const { return m <= 0.05 && deg <= 0.5; }
};

/// All attempts of a method, in the order of the set.
struct MethodAttempts {
  std::string name;
  bool ours = false;
  std::vector<Attempt> attempts;
};

/// The methods on one set of pairs and starts.
struct AccuracySet {
  std::string title;
  std::vector<std::string> names;     ///< Of the attempts; empty: they are not listed.
  double truth_m = 0, truth_deg = 0;  ///< How well the worst known truth is known.
  double most_m = 0;                  ///< Bar: robust ends no farther from the truth. 0: no bar.
  std::vector<MethodAttempts> methods;
};

/// Prints the set in Markdown: a row per method; the errors of each attempt, where it has names;
/// and whether robust meets the bars. Returns whether it meets all of them:
/// - as many successes as the best other method of ours;
/// - where point_to_plane without a gate, with one, or with Huber's loss succeeds, a median error
/// of
///   at most the larger of 1.1 times that of the best of the three in each attempt, and the truth's
///   own accuracy;
/// - no error above most_m.
bool PrintAccuracy(const AccuracySet& set);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_TABLE_H_
