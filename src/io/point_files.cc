// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/point_files.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "icpscape/common/error.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/output.h"
#include "icpscape/io/pcd.h"
#include "icpscape/io/ply.h"
#include "icpscape/io/whole_file.h"

namespace icpscape {
namespace {

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
  return extension == ".bin" || extension == ".pcd" || extension == ".ply" ? extension : "";
}

PointCloud ReadPointFile(const std::filesystem::path& path, DroppedPoints* dropped) {
  const std::string kind = PointFileKind(path);
  if (kind.empty()) {
    throw InputError(path.string() + ": extension \"" + path.extension().string() +
                     "\"; expected .bin, .pcd or .ply.");
  }
  if (kind == ".bin") {
    return ReadVelodyne(path, dropped);
  }
  std::string bytes = ReadWholeFile(path, "a point cloud");
  return CloudOf(
      kind == ".ply" ? ReadPly(path.string(), bytes) : ReadPcd(path.string(), std::move(bytes)),
      dropped);
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
