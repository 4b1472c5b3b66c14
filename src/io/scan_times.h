// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_SCAN_TIMES_H_
#define ICPSCAPE_SRC_IO_SCAN_TIMES_H_

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace icpscape {

/// What ScanTimes::from says where times are made up.
inline constexpr char kNoTimes[] = "none, taken as 10 Hz";
inline constexpr char kTimesByNumber[] = "numbers of the scans, taken as 10 Hz";

/// When the scans of a sequence were taken.
struct ScanTimes {
  std::vector<double> times_s;  ///< Increasing.
  bool are_measured = false;    ///< Else made up from kScanPeriodS.
  std::string from;             ///< For people: "names of the scans".
};

/// A file of times, one per line: increasing, NaN where a line is blank (so KITTI marks scans that
/// were lost). Seconds; or KITTI's dates and times, as seconds since the month began; or whole
/// numbers of 13, 16 or 19 digits, which are milli-, micro- and nanoseconds. Nothing where there is
/// no file. Throws InputError.
std::vector<double> ReadTimes(const std::filesystem::path& path);

/// The same for a file that must be there, with a time for each of `count` scans: the first word of
/// each line, so that a trajectory of TUM's will do. Blank lines and those that begin with # are
/// passed over. Throws InputError.
std::vector<double> ReadTimesOfScans(const std::filesystem::path& path, std::size_t count);

/// The times that ordered names of scans (without extensions) spell. A name may begin with
/// anything that has no digit; what follows is
///   a stamp: seconds with a decimal point (or ten digits), milli-, micro- or nanoseconds as 13, 16
///     or 19 digits, or seconds and nanoseconds as in 1583836591_182590976; or
///   a running number, all else being equal: it counts periods of kScanPeriodS, in units of the
///     smallest step. Where a step is more than ten times as large as another it counts none.
/// Names that spell neither are kScanPeriodS apart.
ScanTimes TimesFromNames(const std::vector<std::string>& names);

/// `count` times, kScanPeriodS apart.
ScanTimes EvenTimes(std::size_t count);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_SCAN_TIMES_H_
