// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/scan_sequence.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <utility>

#include "icpscape/cloud/constant_velocity.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

template <class T>
std::vector<T> Part(const std::vector<T>& all, std::size_t first, std::size_t end) {
  const auto begin = all.begin();
  return {begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end)};
}

std::string Count(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

}  // namespace

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

ScanSequence ScanSequence::Frames(const FrameRange& range) const {
  const std::size_t count = scans.size();
  const auto first = static_cast<std::size_t>(range.first);
  const std::size_t end = range.last < 0 ? count : static_cast<std::size_t>(range.last) + 1;
  if (first >= end || end > count) {
    throw InputError(place.string() + ": " + Count(count, "scans") + "; expected frames within 0:" +
                     std::to_string(count == 0 ? 0 : count - 1) + ".");
  }
  ScanSequence part = *this;
  part.scans = Part(scans, first, end);
  part.times_s = Part(times_s, first, end);
  for (std::size_t i = first; i < end; ++i) {
    const Scan& scan = scans[i];
    if (!scan.file.empty() && !std::filesystem::exists(scan.file)) {
      throw InputError(scan.file.string() + ": no such scan; expected all of the frames " +
                       std::to_string(first) + ":" + std::to_string(end - 1) + ".");
    }
    if (std::isnan(times_s[i])) {
      throw InputError(times_file.string() + ": no time for " + scan.name +
                       "; expected a line for each scan.");
    }
  }
  if (!T_world_lidar.empty()) {
    if (T_world_lidar.size() < end) {
      throw InputError(poses_file.string() + ": " + Count(T_world_lidar.size(), "rows") +
                       "; expected a row for frame " + std::to_string(end - 1) + ".");
    }
    part.T_world_lidar = Part(T_world_lidar, first, end);
    part.T_world_camera =
        T_world_camera.empty() ? T_world_camera : Part(T_world_camera, first, end);
  }
  return part;
}

void ScanSequence::Reverse() {
  std::reverse(scans.begin(), scans.end());
  std::reverse(T_world_lidar.begin(), T_world_lidar.end());
  std::reverse(T_world_camera.begin(), T_world_camera.end());
  const std::vector<double> forwards = times_s;
  std::transform(forwards.rbegin(), forwards.rend(), times_s.begin(),
                 [&](double t) { return forwards.front() + (forwards.back() - t); });
  for (Scan& scan : scans) {
    scan.read = [read = std::move(scan.read)](DroppedPoints* dropped) {
      PointCloud cloud = read(dropped);
      std::transform(cloud.time_s.begin(), cloud.time_s.end(), cloud.time_s.begin(),
                     std::negate<float>());
      return cloud;
    };
  }
  title += " reversed";
}

std::string ScanSequence::TimesText() const {
  std::vector<double> spans;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    spans.push_back(times_s[i] - times_s[i - 1]);
  }
  std::sort(spans.begin(), spans.end());
  const auto first_gap = std::find_if(spans.begin(), spans.end(), [&](double span) {
    return span > 1.5 * spans[(spans.size() - 1) / 2];
  });
  const auto gaps = spans.end() - first_gap;
  if (gaps == 0) {
    return times_from;
  }
  return times_from + ", " +
         (gaps == 1 ? "1 gap of " : std::to_string(gaps) + " gaps, the longest of ") +
         Number(std::round(1e3 * spans.back()) / 1e3) + " s";
}

std::optional<SE3d> ScanSequence::Motion(int to, int from) const {
  if (T_world_lidar.empty()) {
    return std::nullopt;
  }
  for (const int frame : {to, from}) {
    if (frame < 0 || static_cast<std::size_t>(frame) >= T_world_lidar.size()) {
      throw InputError(poses_file.string() + ": " + Count(T_world_lidar.size(), "rows") +
                       "; expected a row for frame " + std::to_string(frame) + ".");
    }
  }
  const auto to_index = static_cast<std::size_t>(to);
  const auto from_index = static_cast<std::size_t>(from);
  if (T_world_camera.empty()) {
    return T_world_lidar[to_index].Inverse() * T_world_lidar[from_index];
  }
  return T_camera_lidar->Inverse() * T_world_camera[to_index].Inverse() *
         T_world_camera[from_index] * *T_camera_lidar;
}

ScanPair ScanSequence::Pair(
    int source, int target,
    const std::function<PointCloud(const char* role, const Scan&)>& read) const {
  for (const int frame : {source, target}) {
    if (frame < 0 || static_cast<std::size_t>(frame) >= scans.size()) {
      throw InputError(place.string() + ": no scan " + std::to_string(frame) + " among " +
                       Count(scans.size(), "scans") + ", which are numbered from 0.");
    }
  }
  ScanPair pair;
  pair.title = title + ", scan " + std::to_string(source) + " to " + std::to_string(target);
  pair.T_ground_truth = Motion(target, source);
  pair.truth_is_exact = truth_is_exact;
  if (source > 0 && target > 0) {
    pair.T_predicted = Motion(target - 1, source - 1);
    if (pair.T_predicted && times_s.size() == scans.size()) {
      const auto from = times_s.begin() + target, to = times_s.begin() + source;
      pair.T_predicted = MotionDuring(*to - *from, *pair.T_predicted, *(to - 1) - *(from - 1));
    }
  }
  pair.source = read("source", scans[static_cast<std::size_t>(source)]);
  pair.target = read("target", scans[static_cast<std::size_t>(target)]);
  pair.SettleOrigins();
  return pair;
}

ScanPair ScanSequence::Pair(int source, int target) const {
  return Pair(source, target, [](const char*, const Scan& scan) {
    DroppedPoints dropped;
    return scan.read(&dropped);
  });
}

}  // namespace icpscape
