// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/trajectory.h"

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/output.h"
#include "icpscape/io/transform.h"

namespace icpscape {
namespace {

constexpr std::size_t kKittiColumns = 12;
constexpr std::size_t kTumColumns = 8;
constexpr double kUnitTolerance = 1e-3;  // Text rounds.
constexpr double kFarthestM = 1e9;       // Beyond every coordinate on Earth.

std::vector<std::string> Words(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), std::istream_iterator<std::string>()};
}

bool IsComment(const std::vector<std::string>& words) {
  return !words.empty() && words[0][0] == '#';
}

std::ifstream Open(const std::filesystem::path& path) {
  // It is read twice: no pipe would do.
  std::ifstream in(path);
  if (!in || !std::filesystem::is_regular_file(path)) {
    throw InputError(path.string() + ": cannot be read; expected a trajectory, KITTI's or TUM's.");
  }
  return in;
}

// Words of the first line that is neither blank nor a comment; empty if there is no such line.
std::vector<std::string> FirstRow(const std::filesystem::path& path) {
  std::ifstream in = Open(path);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> words = Words(line);
    if (!words.empty() && !IsComment(words)) {
      return words;
    }
  }
  return {};
}

void CheckPosition(const SE3d& T, const std::string& place) {
  const double farthest = T.t().cwiseAbs().maxCoeff();
  if (!(farthest <= kFarthestM)) {
    throw InputError(place + ": a coordinate of " + Number(farthest) +
                     " m; expected at most 1e9 m.");
  }
}

void AddTumRow(const std::vector<std::string>& words, const std::string& place,
               Trajectory* trajectory) {
  if (words.size() != kTumColumns) {
    throw InputError(place + ": " + std::to_string(words.size()) +
                     " columns; expected 8: timestamp tx ty tz qx qy qz qw.");
  }
  std::array<double, kTumColumns> v;
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i] = ParseNumber(words[i]);
    if (!std::isfinite(v[i])) {
      throw InputError(place + ": \"" + words[i].substr(0, 40) + "\"; expected a finite number.");
    }
  }
  const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
  if (!(std::abs(q.norm() - 1) <= kUnitTolerance)) {
    throw InputError(place + ": the quaternion has norm " + Number(q.norm()) + "; expected 1.");
  }
  if (!trajectory->times_s.empty() && v[0] <= trajectory->times_s.back()) {
    throw InputError(place + ": timestamp " + words[0] +
                     " is not after the one before; expected increasing times.");
  }
  trajectory->times_s.push_back(v[0]);
  trajectory->T_world_body.emplace_back(q.normalized().toRotationMatrix(), Vec3(v[1], v[2], v[3]));
  CheckPosition(trajectory->T_world_body.back(), place);
}

Trajectory ReadKitti(const std::filesystem::path& path) {
  Trajectory trajectory{ReadKittiPoses(path), {}};
  for (std::size_t i = 0; i < trajectory.T_world_body.size(); ++i) {
    CheckPosition(trajectory.T_world_body[i], path.string() + ":" + std::to_string(i + 1));
  }
  return trajectory;
}

Trajectory ReadTum(const std::filesystem::path& path) {
  std::ifstream in = Open(path);
  Trajectory trajectory;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::vector<std::string> words = Words(line);
    if (!words.empty() && !IsComment(words)) {
      AddTumRow(words, path.string() + ":" + std::to_string(number), &trajectory);
    }
  }
  return trajectory;
}

}  // namespace

Trajectory ReadTrajectory(const std::filesystem::path& path) {
  const std::size_t columns = FirstRow(path).size();
  if (columns == kKittiColumns) {
    return ReadKitti(path);
  }
  if (columns == kTumColumns) {
    return ReadTum(path);
  }
  throw InputError(path.string() + ": the first row has " + std::to_string(columns) +
                   " columns; expected 12 (KITTI's poses) or 8 (TUM's).");
}

void WriteKittiTrajectory(const std::filesystem::path& path,
                          const std::vector<SE3d>& T_world_body) {
  std::string text;
  for (const SE3d& T : T_world_body) {
    text += FormatTransformRow(T) + "\n";
  }
  WriteTextFile(path, text);
}

void WriteTumTrajectory(const std::filesystem::path& path, const Trajectory& trajectory) {
  if (trajectory.times_s.size() != trajectory.T_world_body.size()) {
    throw UsageError(path.string() + ": " + std::to_string(trajectory.times_s.size()) +
                     " times for " + std::to_string(trajectory.T_world_body.size()) +
                     " poses; expected one for each, as the format of TUM asks.");
  }
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < trajectory.times_s.size(); ++i) {
    const Vec3& t = trajectory.T_world_body[i].t();
    const Eigen::Quaterniond q = trajectory.T_world_body[i].Quaternion();
    std::vector<std::string> words;
    for (const double value :
         {trajectory.times_s[i], t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      words.push_back(Number(value));
    }
    text += Join(words, " ") + "\n";
  }
  WriteTextFile(path, text);
}

}  // namespace icpscape
