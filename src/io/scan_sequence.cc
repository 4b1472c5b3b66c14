// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/scan_sequence.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numeric>
#include <set>

#include "src/common/error.h"
#include "src/common/text.h"
#include "src/io/kitti.h"

namespace icpscape {
namespace {

constexpr double kLargestFrame = 1e9;

double NumberOf(const std::filesystem::path& scan) { return ParseNumber(scan.stem().string()); }

// The files that ReadPointFile takes, in order.
std::vector<std::filesystem::path> ScansIn(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> scans;
  std::set<std::string> kinds;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string kind = entry.path().extension().string();
    if (kind == ".bin" || kind == ".pcd" || kind == ".ply") {
      scans.push_back(entry.path());
      kinds.insert(kind);
    }
  }
  if (error || scans.empty()) {
    throw InputError(folder.string() + ": no scan; expected a folder of .bin, .pcd or .ply files.");
  }
  if (kinds.size() > 1) {
    throw InputError(folder.string() + ": holds " + Join({kinds.begin(), kinds.end()}, " and ") +
                     " files; expected scans of one kind.");
  }
  const bool are_numbers = std::all_of(
      scans.begin(), scans.end(), [](const auto& scan) { return std::isfinite(NumberOf(scan)); });
  std::sort(scans.begin(), scans.end(), [&](const auto& a, const auto& b) {
    return are_numbers && NumberOf(a) != NumberOf(b) ? NumberOf(a) < NumberOf(b) : a < b;
  });
  return scans;
}

// "12.5", or KITTI's "2011-09-26 14:14:10.911685885" as seconds since the month began.
double ParseTime(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, length = 0;
  if (std::sscanf(text.c_str(), "%d-%d-%d %d:%d:%n", &year, &month, &day, &hour, &minute,
                  &length) == 5) {
    return ((day * 24.0 + hour) * 60 + minute) * 60 +
           ParseNumber(text.substr(static_cast<std::size_t>(length)));
  }
  return ParseNumber(text);
}

// Of the scans, whose frames these are: line by line of `times`; made up where there are none.
void SetTimes(const std::vector<double>& times, const std::vector<std::size_t>& frames,
              const std::filesystem::path& path, ScanSequence* sequence) {
  sequence->times_are_measured = !times.empty();
  constexpr double kPeriod_s = 0.1;
  for (const std::size_t frame : frames) {
    if (sequence->times_are_measured && (frame >= times.size() || std::isnan(times[frame]))) {
      throw InputError(path.string() + ":" + std::to_string(frame + 1) +
                       ": no time; expected one for frame " + std::to_string(frame) + ".");
    }
    sequence->times_s.push_back(
        sequence->times_are_measured ? times[frame] : static_cast<double>(frame) * kPeriod_s);
  }
}

std::vector<std::size_t> Consecutive(int first, std::size_t count) {
  std::vector<std::size_t> frames(count);
  std::iota(frames.begin(), frames.end(), static_cast<std::size_t>(first));
  return frames;
}

// The number that a scan of a raw drive has by its name, which is its line of timestamps.txt: some
// drives lack scans.
std::size_t FrameOfName(const std::filesystem::path& scan) {
  const double number = NumberOf(scan);
  if (!(number >= 0 && number <= kLargestFrame && number == std::floor(number))) {
    throw InputError(scan.string() + ": no scan of a raw drive; expected names like " +
                     "0000000000.bin.");
  }
  return static_cast<std::size_t>(number);
}

int LastFrame(const KittiSequence& kitti) {
  const std::filesystem::path folder = kitti.ScanPath(0).parent_path();
  int last = -1;
  for (const std::filesystem::path& scan : ScansIn(folder)) {
    const double number = NumberOf(scan);
    if (number >= 0 && number <= kLargestFrame &&
        kitti.ScanPath(static_cast<int>(number)) == scan) {
      last = std::max(last, static_cast<int>(number));
    }
  }
  if (last < 0) {
    throw InputError(folder.string() + ": no scan; expected 000000.bin, 000001.bin and so on.");
  }
  return last;
}

}  // namespace

std::vector<double> ReadTimes(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<double> times;
  double last = -std::numeric_limits<double>::infinity();
  for (std::string line; std::getline(in, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    times.push_back(ParseTime(line));
    if (line.empty()) {
      continue;
    }
    if (!std::isfinite(times.back()) || !(times.back() > last)) {
      throw InputError(path.string() + ":" + std::to_string(times.size()) + ": \"" + line +
                       "\"; expected a time after the one before.");
    }
    last = times.back();
  }
  return times;
}

FrameRange FrameRangeFromText(const std::string& text) {
  FrameRange range;
  if (text.empty()) {
    return range;
  }
  const char* const end = text.data() + text.size();
  const auto [colon, error] = std::from_chars(text.data(), end, range.first);
  bool good = error == std::errc() && colon != end && *colon == ':';
  if (good) {
    const auto [rest, last_error] = std::from_chars(colon + 1, end, range.last);
    good = last_error == std::errc() && rest == end;
  }
  if (!good || range.first < 0 || range.last < range.first) {
    throw UsageError("frames=" + text +
                     ": expected FIRST:LAST with 0 <= FIRST <= LAST, as in 0:99.");
  }
  return range;
}

void ScanSequence::Reverse() {
  std::reverse(scans.begin(), scans.end());
  std::reverse(T_world_lidar.begin(), T_world_lidar.end());
  title += " reversed";
}

ScanSequence OpenKittiSequence(const std::filesystem::path& root, const std::string& name,
                               const FrameRange& frames) {
  const KittiSequence kitti(root, name);
  ScanSequence sequence;
  const bool is_simulated =
      std::filesystem::exists(kitti.CalibrationPath().parent_path() / "simulation.json");
  sequence.title = (is_simulated ? "simulated " : "KITTI ") + name;
  const int last = frames.last >= 0 ? frames.last : LastFrame(kitti);
  for (int frame = frames.first; frame <= last; ++frame) {
    sequence.scans.push_back(kitti.ScanPath(frame));
    if (!std::filesystem::exists(sequence.scans.back())) {
      throw InputError(sequence.scans.back().string() +
                       ": no such scan; expected all of the frames " +
                       std::to_string(frames.first) + ":" + std::to_string(last) + ".");
    }
  }
  if (sequence.scans.empty()) {
    throw InputError(kitti.ScanPath(frames.first).string() + ": no such scan; the last one is " +
                     std::to_string(last) + ".");
  }
  const auto first = static_cast<std::size_t>(frames.first);
  const std::filesystem::path times = kitti.CalibrationPath().parent_path() / "times.txt";
  SetTimes(ReadTimes(times), Consecutive(frames.first, sequence.scans.size()), times, &sequence);
  if (std::filesystem::exists(kitti.CalibrationPath())) {
    sequence.T_camera_lidar = ReadKittiCalibration(kitti.CalibrationPath());
    if (std::filesystem::exists(kitti.PosesPath())) {
      const std::vector<SE3d> poses = kitti.LidarPoses();
      if (poses.size() < first + sequence.scans.size()) {
        throw InputError(kitti.PosesPath().string() + ": " + std::to_string(poses.size()) +
                         " rows; expected a row for frame " + std::to_string(last) + ".");
      }
      const auto begin = poses.begin() + static_cast<std::ptrdiff_t>(first);
      sequence.T_world_lidar = {begin, begin + static_cast<std::ptrdiff_t>(sequence.scans.size())};
    }
  }
  return sequence;
}

ScanSequence OpenScanFolder(const std::filesystem::path& folder, const FrameRange& frames) {
  ScanSequence sequence;
  sequence.title = std::filesystem::absolute(folder / ".").parent_path().filename().string();
  const std::filesystem::path raw = folder / "velodyne_points";
  const bool is_raw = std::filesystem::is_directory(raw / "data");
  std::vector<std::filesystem::path> scans = ScansIn(is_raw ? raw / "data" : folder);
  const int count = static_cast<int>(scans.size());
  if (frames.first >= count || frames.last >= count) {
    throw InputError(folder.string() + ": " + std::to_string(count) +
                     " scans; expected frames within 0:" + std::to_string(count - 1) + ".");
  }
  sequence.scans = {scans.begin() + frames.first,
                    frames.last < 0 ? scans.end() : scans.begin() + frames.last + 1};
  if (!is_raw) {
    SetTimes({}, Consecutive(frames.first, sequence.scans.size()), "", &sequence);
    return sequence;
  }
  std::vector<std::size_t> lines(sequence.scans.size());
  std::transform(sequence.scans.begin(), sequence.scans.end(), lines.begin(), FrameOfName);
  std::vector<double> times = ReadTimes(raw / "timestamps.txt");
  const auto start =
      std::find_if(times.begin(), times.end(), [](double t) { return !std::isnan(t); });
  std::transform(times.begin(), times.end(), times.begin(),
                 [start_s = start == times.end() ? 0 : *start](double t) { return t - start_s; });
  SetTimes(times, lines, raw / "timestamps.txt", &sequence);
  return sequence;
}

}  // namespace icpscape
