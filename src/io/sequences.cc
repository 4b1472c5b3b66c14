// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/sequences.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numeric>
#include <set>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/natural_order.h"
#include "icpscape/io/point_files.h"

namespace icpscape {
namespace {

constexpr double kLargestFrame = 1e9;

double NumberOf(const std::filesystem::path& scan) { return ParseNumber(scan.stem().string()); }

std::vector<std::size_t> CountUp(std::size_t count) {
  std::vector<std::size_t> lines(count);
  std::iota(lines.begin(), lines.end(), std::size_t{0});
  return lines;
}

// The numbers that the names are behind their first `letters` letters, which are the same; nothing
// where one of them is none.
std::vector<double> NumbersBehind(std::size_t letters,
                                  const std::vector<std::filesystem::path>& scans) {
  const std::string first = scans.front().stem().string();
  std::vector<double> numbers;
  for (const std::filesystem::path& scan : scans) {
    const std::string name = scan.stem().string();
    if (name.size() <= letters || name.compare(0, letters, first, 0, letters) != 0 ||
        !std::isfinite(ParseNumber(name.substr(letters)))) {
      return {};
    }
    numbers.push_back(ParseNumber(name.substr(letters)));
  }
  return numbers;
}

// By number where all names are numbers ("-1.5", "10"), or the same letters and a number ("t9.5",
// "t10"); else, and among equal numbers, in natural order.
void Sort(std::vector<std::filesystem::path>* scans) {
  std::sort(scans->begin(), scans->end(), [](const auto& a, const auto& b) {
    return ComesBefore(a.stem().string(), b.stem().string());
  });
  std::vector<double> numbers = NumbersBehind(0, *scans);
  if (numbers.empty()) {
    numbers = NumbersBehind(scans->front().stem().string().find_first_of("0123456789"), *scans);
  }
  std::vector<std::size_t> order = CountUp(numbers.size());
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  const std::vector<std::filesystem::path> natural = *scans;
  std::transform(order.begin(), order.end(), scans->begin(),
                 [&](std::size_t i) { return natural[i]; });
}

// The files that ReadPointFile takes, in order.
std::vector<std::filesystem::path> ScansIn(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> scans;
  std::set<std::string> kinds;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string kind = entry.path().extension().string();
    if (entry.path().filename().string()[0] == '.') {
      continue;  // Hidden, as files are that are not yet whole; see WriteThenRename.
    }
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
  Sort(&scans);
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

Scan FileOf(const std::filesystem::path& path) {
  return {path.filename().string(), path,
          [path](DroppedPoints* dropped) { return ReadPointFile(path, dropped); }};
}

// Line `lines[i]` of the file's times is that of scan i; made up where there is no such file.
void SetTimes(const std::filesystem::path& file, const std::vector<double>& times,
              const std::vector<std::size_t>& lines, ScanSequence* sequence) {
  sequence->times_file = file;
  sequence->times_are_measured = !times.empty();
  for (const std::size_t line : lines) {
    if (times.empty()) {
      sequence->times_s.push_back(static_cast<double>(line) * kScanPeriodS);
    } else {
      sequence->times_s.push_back(line < times.size() ? times[line]
                                                      : std::numeric_limits<double>::quiet_NaN());
    }
  }
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

// Of the files NNNNNN.bin; -1 where there is none.
int LastFrame(const KittiFiles& kitti) {
  std::error_code no_folder;
  int last = -1;
  for (const auto& entry :
       std::filesystem::directory_iterator(kitti.Scan(0).parent_path(), no_folder)) {
    const double number = NumberOf(entry.path());
    if (number >= 0 && number <= kLargestFrame &&
        kitti.Scan(static_cast<int>(number)).filename() == entry.path().filename()) {
      last = std::max(last, static_cast<int>(number));
    }
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

ScanSequence OpenKittiSequence(const std::filesystem::path& root, const std::string& name) {
  const KittiFiles kitti(root, name);
  ScanSequence sequence;
  const bool is_simulated =
      std::filesystem::exists(kitti.Calibration().parent_path() / "simulation.json");
  sequence.title = (is_simulated ? "simulated " : "KITTI ") + name;
  sequence.place = kitti.Scan(0).parent_path();
  const int last = LastFrame(kitti);
  for (int frame = 0; frame <= last; ++frame) {
    sequence.scans.push_back(FileOf(kitti.Scan(frame)));
  }
  SetTimes(kitti.Times(), ReadTimes(kitti.Times()), CountUp(sequence.scans.size()), &sequence);
  if (!std::filesystem::exists(kitti.Calibration())) {
    return sequence;
  }
  const SE3d Tr = ReadKittiCalibration(kitti.Calibration());
  sequence.T_camera_lidar = Tr;
  sequence.inputs.push_back(kitti.Calibration());
  if (std::filesystem::exists(kitti.Poses())) {
    sequence.poses_file = kitti.Poses();
    sequence.inputs.push_back(kitti.Poses());
    sequence.T_world_camera = ReadKittiPoses(kitti.Poses());
    if (sequence.T_world_camera.empty()) {
      throw InputError(kitti.Poses().string() + ": no rows; expected one pose per frame.");
    }
    const SE3d T_first_camera = Tr.Inverse() * sequence.T_world_camera[0].Inverse();
    for (const SE3d& pose : sequence.T_world_camera) {
      sequence.T_world_lidar.push_back(T_first_camera * pose * Tr);
    }
  }
  return sequence;
}

ScanSequence OpenScanFolder(const std::filesystem::path& folder) {
  ScanSequence sequence;
  sequence.title = std::filesystem::absolute(folder / ".").parent_path().filename().string();
  sequence.place = folder;
  const std::filesystem::path raw = folder / "velodyne_points";
  const bool is_raw = std::filesystem::is_directory(raw / "data");
  const std::vector<std::filesystem::path> files = ScansIn(is_raw ? raw / "data" : folder);
  std::transform(files.begin(), files.end(), std::back_inserter(sequence.scans), FileOf);
  if (!is_raw) {
    SetTimes("", {}, CountUp(files.size()), &sequence);
    return sequence;
  }
  std::vector<std::size_t> lines(files.size());
  std::transform(files.begin(), files.end(), lines.begin(), FrameOfName);
  std::vector<double> times = ReadTimes(raw / "timestamps.txt");
  const auto start =
      std::find_if(times.begin(), times.end(), [](double t) { return !std::isnan(t); });
  std::transform(times.begin(), times.end(), times.begin(),
                 [start_s = start == times.end() ? 0 : *start](double t) { return t - start_s; });
  SetTimes(raw / "timestamps.txt", times, lines, &sequence);
  return sequence;
}

ScanSequence OpenTwoScans(const std::filesystem::path& source,
                          const std::filesystem::path& target) {
  ScanSequence sequence;
  sequence.title = source.filename().string() + " to " + target.filename().string();
  sequence.scans = {FileOf(target), FileOf(source)};
  SetTimes("", {}, CountUp(2), &sequence);
  return sequence;
}

}  // namespace icpscape
