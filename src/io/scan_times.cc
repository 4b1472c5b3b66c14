// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/scan_times.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

constexpr char kDigits[] = "0123456789";
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargestStep = 10;  // Of running numbers, in units of the smallest.

bool AllDigits(const std::string& text) {
  return !text.empty() && text.find_first_not_of(kDigits) == std::string::npos;
}

// Ticks a second of a whole number that is a stamp: between 2001 and 2286, no other count of
// seconds, milli-, micro- or nanoseconds since 1970 has its digits. 0 where it is none.
double TicksPerSecond(const std::string& text) {
  if (!AllDigits(text) || text[0] == '0') {
    return 0;
  }
  switch (text.size()) {
    case 10:
      return 1;
    case 13:
      return 1e3;
    case 16:
      return 1e6;
    case 19:
      return 1e9;
    default:
      return 0;
  }
}

double ParseSeconds(const std::string& text) {
  const double ticks = TicksPerSecond(text);
  return ParseNumber(text) / (ticks > 0 ? ticks : 1);
}

// Also KITTI's "2011-09-26 14:14:10.911685885", as seconds since the month began.
double ParseTime(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, length = 0;
  if (std::sscanf(text.c_str(), "%d-%d-%d %d:%d:%n", &year, &month, &day, &hour, &minute,
                  &length) == 5) {
    return ((day * 24.0 + hour) * 60 + minute) * 60 +
           ParseNumber(text.substr(static_cast<std::size_t>(length)));
  }
  return ParseSeconds(text);
}

// Throws InputError unless `time` is one, after `last`.
void RequireLater(double time, double last, const std::string& line,
                  const std::filesystem::path& path, std::size_t number) {
  if (!std::isfinite(time) || !(time > last)) {
    throw InputError(path.string() + ":" + std::to_string(number) + ": \"" + line +
                     "\"; expected a time after the one before.");
  }
}

// What a name spells behind its letters: a stamp and its unit.
struct Stamp {
  double time_s = kNaN;
  std::string unit;
};

Stamp StampOf(const std::string& name) {
  const std::size_t begin = name.find_first_of(kDigits);
  const std::string text = begin == std::string::npos ? "" : name.substr(begin);
  const std::size_t end = std::min(text.find_first_not_of(kDigits), text.size());
  const std::string whole = text.substr(0, end);
  const std::string rest = end < text.size() ? text.substr(end + 1) : "";
  if (end == text.size()) {
    const double ticks = TicksPerSecond(whole);
    return {ticks > 0 ? ParseSeconds(whole) : kNaN, Number(ticks)};
  }
  if (text[end] == '.' && AllDigits(rest)) {
    return {ParseNumber(text), "decimal"};
  }
  if ((text[end] == '_' || text[end] == '-') && TicksPerSecond(whole) == 1 && AllDigits(rest) &&
      rest.size() <= 9) {
    return {ParseNumber(whole) + 1e-9 * ParseNumber(rest), "pair"};
  }
  return {};
}

bool Increase(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(),
                            [](double a, double b) { return !(a < b); }) == values.end();
}

std::optional<std::vector<double>> StampsOf(const std::vector<std::string>& names) {
  std::vector<double> times;
  for (const std::string& name : names) {
    const Stamp stamp = StampOf(name);
    if (std::isnan(stamp.time_s) || stamp.unit != StampOf(names[0]).unit) {
      return std::nullopt;
    }
    times.push_back(stamp.time_s);
  }
  return Increase(times) ? std::optional(times) : std::nullopt;
}

// "run2_scan_010" -> "run", "2", "_scan_", "010".
std::vector<std::string> Parts(const std::string& name) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < name.size(); i += parts.back().size()) {
    const bool is_digit = AllDigits(name.substr(i, 1));
    const std::size_t end =
        is_digit ? name.find_first_not_of(kDigits, i) : name.find_first_of(kDigits, i);
    parts.push_back(name.substr(i, end == std::string::npos ? end : end - i));
  }
  return parts;
}

// The one number in which the names differ; nothing where they differ otherwise.
std::optional<std::vector<double>> RunningNumbers(const std::vector<std::string>& names) {
  const std::vector<std::string> first = Parts(names.front()), last = Parts(names.back());
  const auto differing = std::mismatch(first.begin(), first.end(), last.begin(), last.end()).first;
  const auto place = static_cast<std::size_t>(differing - first.begin());
  std::vector<double> numbers;
  for (const std::string& name : names) {
    std::vector<std::string> parts = Parts(name);
    if (place >= first.size() || parts.size() != first.size() || !AllDigits(parts[place])) {
      return std::nullopt;
    }
    numbers.push_back(ParseNumber(parts[place]));
    parts[place] = first[place];
    if (parts != first) {
      return std::nullopt;
    }
  }
  return Increase(numbers) ? std::optional(numbers) : std::nullopt;
}

}  // namespace

std::vector<double> ReadTimes(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<double> times;
  double last = -std::numeric_limits<double>::infinity();
  for (std::string line; std::getline(in, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    times.push_back(line.empty() ? kNaN : ParseTime(line));
    if (!line.empty()) {
      RequireLater(times.back(), last, line, path, times.size());
      last = times.back();
    }
  }
  return times;
}

std::vector<double> ReadTimesOfScans(const std::filesystem::path& path, std::size_t count) {
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path)) {
    throw InputError(path.string() + ": cannot be read; expected the times of the scans.");
  }
  std::vector<double> times;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line.erase(line.find_last_not_of(" \t\r") + 1);
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string::npos || line[begin] == '#') {
      continue;
    }
    double time = ParseTime(line);
    if (std::isnan(time)) {
      time = ParseSeconds(line.substr(begin, line.find_first_of(" \t,", begin) - begin));
    }
    RequireLater(time, times.empty() ? -std::numeric_limits<double>::infinity() : times.back(),
                 line, path, number);
    times.push_back(time);
  }
  if (times.size() != count) {
    throw InputError(path.string() + ": " + std::to_string(times.size()) +
                     " times; expected one for each of the " + std::to_string(count) + " scans.");
  }
  return times;
}

ScanTimes TimesFromNames(const std::vector<std::string>& names) {
  if (const auto stamps = StampsOf(names)) {
    return {*stamps, true, "names of the scans"};
  }
  ScanTimes times = EvenTimes(names.size());
  const auto numbers = names.size() > 1 ? RunningNumbers(names) : std::nullopt;
  if (!numbers) {
    return times;
  }
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 1; i < numbers->size(); ++i) {
    const double step = (*numbers)[i] - (*numbers)[i - 1];
    least = std::min(least, step);
    most = std::max(most, step);
  }
  if (most == least || most > kLargestStep * least) {
    return times;
  }
  times.from = kTimesByNumber;
  for (std::size_t i = 0; i < numbers->size(); ++i) {
    times.times_s[i] = ((*numbers)[i] - numbers->front()) / least * kScanPeriodS;
  }
  return times;
}

ScanTimes EvenTimes(std::size_t count) {
  ScanTimes times;
  times.from = kNoTimes;
  for (std::size_t i = 0; i < count; ++i) {
    times.times_s.push_back(static_cast<double>(i) * kScanPeriodS);
  }
  return times;
}

}  // namespace icpscape
