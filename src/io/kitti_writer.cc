// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/kitti_writer.h"

#include <cstdint>
#include <fstream>

#include "icpscape/common/error.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/output.h"
#include "icpscape/io/trajectory.h"
#include "icpscape/io/transform.h"

namespace icpscape {
namespace {

template <class T>
void WriteBinary(const std::filesystem::path& path, const std::vector<T>& values) {
  WriteThenRename(path, [&](const std::filesystem::path& part) {
    std::ofstream out(part, std::ios::binary);
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
    out.close();
    return out.good();
  });
}

void RequireAll(const std::filesystem::path& path, std::size_t size, const PointCloud& cloud,
                const std::string& what) {
  if (size != cloud.size()) {
    throw UsageError(path.string() + ": " + std::to_string(size) + " " + what + "s for " +
                     std::to_string(cloud.size()) + " points; expected one for each.");
  }
}

}  // namespace

void WriteVelodyne(const std::filesystem::path& path, const PointCloud& cloud) {
  std::vector<float> values;
  values.reserve(4 * cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    values.insert(values.end(), {cloud.x[i], cloud.y[i], cloud.z[i],
                                 cloud.intensity.empty() ? 0.F : cloud.intensity[i]});
  }
  WriteBinary(path, values);
}

void WriteLabels(const std::filesystem::path& path, const PointCloud& cloud) {
  RequireAll(path, cloud.label.size(), cloud, "label");
  WriteBinary(path, cloud.label);
}

void WriteRings(const std::filesystem::path& path, const PointCloud& cloud) {
  RequireAll(path, cloud.ring.size(), cloud, "ring");
  WriteBinary(path, std::vector<std::uint8_t>(cloud.ring.begin(), cloud.ring.end()));
}

void WritePointTimes(const std::filesystem::path& path, const PointCloud& cloud) {
  RequireAll(path, cloud.time_s.size(), cloud, "time");
  WriteBinary(path, cloud.time_s);
}

void WriteKittiPoses(const std::filesystem::path& path, const std::vector<SE3d>& T_world_lidar,
                     const SE3d& Tr) {
  WriteKittiTrajectory(path, KittiPosesOf(T_world_lidar, Tr));
}

void WriteKittiCalibration(const std::filesystem::path& path, const SE3d& Tr) {
  WriteTextFile(path, "Tr: " + FormatTransformRow(Tr) + "\n");
}

}  // namespace icpscape
