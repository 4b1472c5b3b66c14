// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/point_files.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <string>

#include "icpscape/common/error.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/output.h"
#include "icpscape/io/point_file_header.h"

namespace icpscape {
namespace {

// PCL prints its own complaints; ours is the one sentence that the user gets.
class QuietPcl {
 public:
  QuietPcl() : level_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~QuietPcl() { pcl::console::setVerbosityLevel(level_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL level_;
};

template <class Point>
PointCloud FromPcl(const pcl::PCLPointCloud2& blob, bool with_intensity) {
  pcl::PointCloud<Point> points;
  pcl::fromPCLPointCloud2(blob, points);
  PointCloud cloud;
  for (const Point& point : points) {
    cloud.x.push_back(point.x);
    cloud.y.push_back(point.y);
    cloud.z.push_back(point.z);
    if constexpr (std::is_same_v<Point, pcl::PointXYZI>) {
      if (with_intensity) {
        cloud.intensity.push_back(point.intensity);
      }
    }
  }
  return cloud;
}

bool IsFloat(const pcl::PCLPointCloud2& blob, const std::string& name) {
  const int index = pcl::getFieldIndex(blob, name);
  return index >= 0 &&
         blob.fields[static_cast<std::size_t>(index)].datatype == pcl::PCLPointField::FLOAT32;
}

PointCloud ReadWithPcl(const std::filesystem::path& path, bool ply) {
  pcl::PCLPointCloud2 blob;
  int status = -1;
  try {
    const QuietPcl quiet;
    if (ply ? PlyHeaderIsSound(path) : PcdHeaderIsSound(path)) {
      status = ply ? pcl::PLYReader().read(path.string(), blob)
                   : pcl::PCDReader().read(path.string(), blob);
    }
  } catch (const std::exception&) {
    status = -1;
  }
  const std::string kind = ply ? "PLY" : "PCD";
  const std::size_t points = static_cast<std::size_t>(blob.width) * blob.height;
  if (status < 0 || blob.data.size() < points * blob.point_step) {
    throw InputError(path.string() + ": cannot be read; expected a whole " + kind + " file.");
  }
  for (const char* name : {"x", "y", "z"}) {
    if (!IsFloat(blob, name)) {
      throw InputError(path.string() + ": no field " + name + " of 32-bit floats; expected x y z.");
    }
  }
  return IsFloat(blob, "intensity") ? FromPcl<pcl::PointXYZI>(blob, true)
                                    : FromPcl<pcl::PointXYZ>(blob, false);
}

}  // namespace

PointCloud ReadPointFile(const std::filesystem::path& path, DroppedPoints* dropped) {
  const std::string extension = path.extension().string();
  if (extension == ".bin") {
    return ReadVelodyne(path, dropped);
  }
  if (extension != ".pcd" && extension != ".ply") {
    throw InputError(path.string() + ": extension \"" + extension +
                     "\"; expected .bin, .pcd or .ply.");
  }
  if (!std::filesystem::is_regular_file(path)) {
    throw InputError(path.string() + ": cannot be read; expected a point cloud.");
  }
  PointCloud cloud = ReadWithPcl(path, extension == ".ply");
  const std::size_t size = cloud.size();
  *dropped = DropInvalidPoints(&cloud);
  if (cloud.empty()) {
    throw InputError(path.string() + ": no usable point among " + std::to_string(size) +
                     "; expected at least one that is finite and not (0, 0, 0).");
  }
  return cloud;
}

void WritePly(const std::filesystem::path& path, const PointCloud& cloud) {
  pcl::PCLPointCloud2 blob;
  if (cloud.intensity.empty()) {
    pcl::PointCloud<pcl::PointXYZ> points;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      points.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
    }
    pcl::toPCLPointCloud2(points, blob);
  } else {
    pcl::PointCloud<pcl::PointXYZI> points;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      points.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i], cloud.intensity[i]);
    }
    pcl::toPCLPointCloud2(points, blob);
  }
  WriteThenRename(path, [&](const std::filesystem::path& part) {
    const QuietPcl quiet;
    return pcl::PLYWriter().writeBinary(part.string(), blob, Eigen::Vector4f::Zero(),
                                        Eigen::Quaternionf::Identity(), false) == 0;
  });
}

}  // namespace icpscape
