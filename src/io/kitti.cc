// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/kitti.h"

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "icpscape/common/error.h"
#include "icpscape/io/bin_layout.h"
#include "icpscape/io/point_columns.h"
#include "icpscape/io/transform.h"
#include "icpscape/io/whole_file.h"

namespace icpscape {
namespace {

std::ifstream Open(const std::filesystem::path& path, const char* what) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) {
    throw InputError(path.string() + ": cannot be read; expected " + what + ".");
  }
  return in;
}

}  // namespace

PointCloud ReadVelodyne(const std::filesystem::path& path, DroppedPoints* dropped) {
  PointTable table;
  table.place = path.string();
  table.bytes = ReadWholeFile(path, "a KITTI velodyne scan");
  constexpr std::size_t kRecord = 4 * sizeof(float);
  if (table.bytes.size() % kRecord != 0) {
    throw InputError(path.string() + ": " + std::to_string(table.bytes.size()) +
                     " bytes; expected a multiple of 16 (x y z intensity as float32).");
  }
  CheckFourFloats(table.place, table.bytes);
  table.size = table.bytes.size() / kRecord;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    table.columns.push_back(
        {name, NumberType::kFloat, table.columns.size() * sizeof(float), kRecord});
  }
  return CloudOf(table, dropped);
}

void ReadPointTimes(const std::filesystem::path& path, PointCloud* cloud) {
  std::ifstream in = Open(path, "the times of a scan's points");
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  if (bytes != cloud->size() * sizeof(float)) {
    throw InputError(path.string() + ": " + std::to_string(bytes) +
                     " bytes; expected a float32 for " + "each of the scan's " +
                     std::to_string(cloud->size()) + " usable points.");
  }
  cloud->time_s.resize(cloud->size());
  in.read(reinterpret_cast<char*>(cloud->time_s.data()), static_cast<std::streamsize>(bytes));
  if (!in) {
    throw InputError(path.string() + ": reading stopped before byte " + std::to_string(bytes) +
                     "; expected the times of all points.");
  }
}

KittiFiles::KittiFiles(std::filesystem::path root, std::string sequence)
    : root_(std::move(root)), sequence_(std::move(sequence)) {
  const std::filesystem::path folder = root_ / "sequences" / sequence_;
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(folder.string() + ": no such folder; expected a KITTI odometry sequence.");
  }
}

std::filesystem::path KittiFiles::Scan(int frame) const {
  std::array<char, 16> name;
  std::snprintf(name.data(), name.size(), "%06d.bin", frame);
  return root_ / "sequences" / sequence_ / "velodyne" / name.data();
}

std::filesystem::path KittiFiles::PointTimes(int frame) const {
  return root_ / "sequences" / sequence_ / "times" / Scan(frame).stem().concat(".time");
}

std::filesystem::path KittiFiles::Poses() const { return root_ / "poses" / (sequence_ + ".txt"); }

std::filesystem::path KittiFiles::Calibration() const {
  return root_ / "sequences" / sequence_ / "calib.txt";
}

std::filesystem::path KittiFiles::Times() const {
  return root_ / "sequences" / sequence_ / "times.txt";
}

std::vector<SE3d> KittiPosesOf(const std::vector<SE3d>& T_world_lidar, const SE3d& Tr) {
  const SE3d T_first_world = T_world_lidar.front().Inverse();
  std::vector<SE3d> T_first_camera;
  for (const SE3d& T : T_world_lidar) {
    T_first_camera.push_back(Tr * T_first_world * T * Tr.Inverse());
  }
  return T_first_camera;
}

SE3d ReadKittiCalibration(const std::filesystem::path& path) {
  std::ifstream in = Open(path, "a KITTI calib.txt");
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.rfind("Tr:", 0) == 0 || line.rfind("Tr_velo_to_cam:", 0) == 0) {
      return ParseTransform(line.substr(line.find(':') + 1),
                            path.string() + ":" + std::to_string(number));
    }
  }
  throw InputError(path.string() + ": no line begins with \"Tr:\"; expected the 3x4 transform " +
                   "from lidar to camera.");
}

std::vector<SE3d> ReadKittiPoses(const std::filesystem::path& path) {
  std::ifstream in = Open(path, "a KITTI pose file");
  std::vector<SE3d> poses;
  std::string line;
  int blank = 0;  // A blank line is fine at the end; between rows it would shift the frames.
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      blank = blank == 0 ? number : blank;
    } else if (blank > 0) {
      throw InputError(path.string() + ":" + std::to_string(blank) +
                       ": a blank line; expected a row of 12 numbers per frame.");
    } else {
      poses.push_back(ParseTransform(line, path.string() + ":" + std::to_string(number)));
    }
  }
  return poses;
}

}  // namespace icpscape
