// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/resumable/frame_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

// Calls visit(value) for every number of the record, in the order of the line.
template <class Record, class Visit>
void ForEachNumber(Record& record, const Visit& visit) {
  auto& result = record.result;
  visit(result.registered);
  visit(result.recovered);
  visit(result.deskewed);
  visit(result.termination);
  visit(result.converged);
  visit(result.predicted_directions);
  visit(result.uncertain_directions);
  visit(result.iterations);
  visit(result.n);
  visit(result.rmse);
  visit(result.gate_m);
  visit(result.points);
  visit(result.map_points);
  visit(record.read_s);
  visit(record.odometry_s);
}

// The largest value of a type of whole numbers; all of ours are at least 0.
template <class T>
double Largest() {
  if constexpr (std::is_enum_v<T>) {
    return static_cast<double>(Termination::kFailure);
  } else {
    constexpr double kLargestExact = 0x1p53;
    return std::min(static_cast<double>(std::numeric_limits<T>::max()), kLargestExact);
  }
}

// Row by row, as the doubles are: nothing is normalised on the way.
void AddPose(const SE3d& T, std::vector<std::string>* words) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      words->push_back(Number(column < 3 ? T.R()(row, column) : T.t()[row]));
    }
  }
}

}  // namespace

std::string FormatFrameRecord(const FrameRecord& record) {
  std::vector<std::string> words = {record.scan_sha256};
  ForEachNumber(record,
                [&](const auto& value) { words.push_back(Number(static_cast<double>(value))); });
  AddPose(record.result.T_world_lidar, &words);
  AddPose(record.result.motion, &words);
  return Join(words, " ");
}

FrameRecord ParseFrameRecord(const std::string& text, const std::string& place) {
  const std::vector<std::string> words = Split(text, ' ');
  std::size_t next = 1;
  bool good = true;
  const auto number = [&](bool may_be_nan) {
    const std::string word = next < words.size() ? words[next] : "";
    const double value = ParseNumber(word);
    good = good && (std::isfinite(value) || (may_be_nan && word == "nan"));
    ++next;
    return value;
  };
  const auto read = [&](auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_floating_point_v<T>) {
      value = number(true);
    } else {
      const double whole = number(false);
      good = good && whole >= 0 && whole <= Largest<T>() && whole == std::floor(whole);
      value = good ? static_cast<T>(whole) : T();
    }
  };
  const auto pose = [&] {
    Mat3 R;
    Vec3 t;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        (column < 3 ? R(row, column) : t[row]) = number(false);
      }
    }
    return SE3d(R, t);
  };
  FrameRecord record;
  record.scan_sha256 = words.empty() ? "" : words[0];
  ForEachNumber(record, read);
  record.result.T_world_lidar = pose();
  record.result.motion = pose();
  if (!good || next != words.size()) {
    throw InputError(place + ": no record of a scan; expected a journal of an odometry.");
  }
  return record;
}

}  // namespace icpscape
