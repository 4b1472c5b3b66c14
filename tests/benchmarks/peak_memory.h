// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_PEAK_MEMORY_H_
#define ICPSCAPE_TESTS_BENCHMARKS_PEAK_MEMORY_H_

namespace icpscape {

/// The most memory that the program held at once, above what it held when this was made. Linux
/// keeps one such mark per process: one of these at a time.
class PeakMemory {
 public:
  PeakMemory();
  /// In MB of 1e6 bytes; NaN where the system does not tell.
  double Mb() const;

 private:
  double before_mb_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_PEAK_MEMORY_H_
