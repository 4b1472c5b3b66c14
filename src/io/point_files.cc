// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/point_files.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/npy.h"
#include "icpscape/io/output.h"
#include "icpscape/io/pcd.h"
#include "icpscape/io/ply.h"
#include "icpscape/io/text_points.h"
#include "icpscape/io/whole_file.h"

namespace icpscape {
namespace {

constexpr std::array<const char*, 7> kKinds = {".bin", ".pcd", ".ply", ".npy",
                                               ".csv", ".txt", ".xyz"};

PointTable ReadTable(const std::string& kind, const std::string& place, std::string bytes) {
  if (kind == ".ply") {
    return ReadPly(place, bytes);
  }
  if (kind == ".pcd") {
    return ReadPcd(place, std::move(bytes));
  }
  if (kind == ".npy") {
    return ReadNpy(place, std::move(bytes));
  }
  return ReadTextPoints(place, bytes, kind == ".xyz");
}

std::string HeaderOf(const PointCloud& cloud, const std::string& type) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment icpscape\nelement vertex " +
                       std::to_string(cloud.size()) + "\n";
  for (const char* name : {"x", "y", "z"}) {
    header += "property " + type + " " + name + "\n";
  }
  if (!cloud.intensity.empty()) {
    header += "property float intensity\n";
  }
  return header + "end_header\n";
}

void WritePoint(const PointCloud& cloud, std::size_t i, bool is_near, std::ofstream* out) {
  const auto write = [&](auto value) {
    out->write(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const std::vector<float>* const coordinates[] = {&cloud.x, &cloud.y, &cloud.z};
  for (Eigen::Index k = 0; k < 3; ++k) {
    const float value = (*coordinates[k])[i];
    is_near ? write(value) : write(value + cloud.origin[k]);
  }
  if (!cloud.intensity.empty()) {
    write(cloud.intensity[i]);
  }
}

}  // namespace

std::string PointFileKind(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  const auto found = std::find(kKinds.begin(), kKinds.end(), extension);
  return found == kKinds.end() ? "" : extension;
}

PointCloud ReadPointFile(const std::filesystem::path& path, DroppedPoints* dropped) {
  const std::string kind = PointFileKind(path);
  if (kind.empty()) {
    throw InputError(path.string() + ": extension \"" + path.extension().string() +
                     "\"; expected one of " + Join({kKinds.begin(), kKinds.end()}) + ".");
  }
  if (kind == ".bin") {
    return ReadVelodyne(path, dropped);
  }
  return CloudOf(ReadTable(kind, path.string(), ReadWholeFile(path, "a point cloud")), dropped);
}

void WritePly(const std::filesystem::path& path, const PointCloud& cloud) {
  const bool is_near = cloud.origin.isZero(0);
  WriteThenRename(path, [&](const std::filesystem::path& part) {
    std::ofstream out(part, std::ios::binary);
    out << HeaderOf(cloud, is_near ? "float" : "double");
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      WritePoint(cloud, i, is_near, &out);
    }
    out.close();
    return out.good();
  });
}

}  // namespace icpscape
