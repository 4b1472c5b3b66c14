// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/sequences.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/natural_order.h"
#include "icpscape/io/point_files.h"
#include "icpscape/io/scan_times.h"

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

// The files of scans, in order. Files of text may hold anything else.
std::vector<std::filesystem::path> ScansIn(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> scans;
  std::set<std::string> kinds;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string kind = PointFileKind(entry.path());
    if (entry.path().filename().string()[0] == '.') {
      continue;  // Hidden, as files are that are not yet whole; see WriteThenRename.
    }
    if (kind == ".bin" || kind == ".pcd" || kind == ".ply" || kind == ".npy") {
      scans.push_back(entry.path());
      kinds.insert(kind);
    }
  }
  if (error || scans.empty()) {
    throw InputError(folder.string() +
                     ": no scan; expected a folder of .bin, .pcd, .ply or .npy files.");
  }
  if (kinds.size() > 1) {
    throw InputError(folder.string() + ": holds " + Join({kinds.begin(), kinds.end()}, " and ") +
                     " files; expected scans of one kind.");
  }
  Sort(&scans);
  return scans;
}

Scan FileOf(const std::filesystem::path& path) {
  return {path.filename().string(), path,
          [path](DroppedPoints* dropped) { return ReadPointFile(path, dropped); }};
}

// With the times of its points where there is a file of them.
Scan ScanOf(const KittiFiles& kitti, int frame) {
  Scan scan = FileOf(kitti.Scan(frame));
  const std::filesystem::path times = kitti.PointTimes(frame);
  if (std::filesystem::exists(times)) {
    scan.times_file = times;
    scan.read = [read = scan.read, times](DroppedPoints* dropped) {
      PointCloud cloud = read(dropped);
      ReadPointTimes(times, &cloud);
      return cloud;
    };
  }
  return scan;
}

void SetTimes(ScanTimes times, ScanSequence* sequence) {
  sequence->times_s = std::move(times.times_s);
  sequence->times_are_measured = times.are_measured;
  sequence->times_from = std::move(times.from);
}

// Line `lines[i]` of a file of times is that of scan i. Without times, lines count periods.
void SetTimes(const std::filesystem::path& file, const std::vector<double>& times,
              const std::vector<std::size_t>& lines, ScanSequence* sequence) {
  sequence->times_file = file;
  sequence->times_are_measured = !times.empty();
  const bool is_even = lines.empty() || lines.back() - lines.front() + 1 == lines.size();
  sequence->times_from = is_even ? kNoTimes : kTimesByNumber;
  if (!times.empty()) {
    sequence->times_from = file.filename().string();
    sequence->inputs.push_back(file);
  }
  for (const std::size_t line : lines) {
    if (times.empty()) {
      sequence->times_s.push_back(static_cast<double>(line) * kScanPeriodS);
    } else {
      sequence->times_s.push_back(line < times.size() ? times[line]
                                                      : std::numeric_limits<double>::quiet_NaN());
    }
  }
}

// Of a folder of scans: in a file beside them, or in their names.
void SetTimesOfFolder(const std::filesystem::path& folder,
                      const std::vector<std::filesystem::path>& files, ScanSequence* sequence) {
  for (const char* name : {"timestamps.txt", "times.txt"}) {
    if (std::filesystem::exists(folder / name)) {
      SetTimesFromFile(folder / name, sequence);
      return;
    }
  }
  std::vector<std::string> names(files.size());
  std::transform(files.begin(), files.end(), names.begin(),
                 [](const auto& file) { return file.stem().string(); });
  SetTimes(TimesFromNames(names), sequence);
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

void SetTimesFromFile(const std::filesystem::path& path, ScanSequence* sequence) {
  sequence->times_s = ReadTimesOfScans(path, sequence->scans.size());
  sequence->times_are_measured = true;
  sequence->times_from = path.filename().string();
  sequence->times_file = path;
  sequence->inputs.push_back(path);
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
    sequence.scans.push_back(ScanOf(kitti, frame));
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
    SetTimesOfFolder(folder, files, &sequence);
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
  SetTimes(EvenTimes(2), &sequence);
  return sequence;
}

}  // namespace icpscape
