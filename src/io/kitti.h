// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_KITTI_H_
#define ICPSCAPE_SRC_IO_KITTI_H_

#include <filesystem>
#include <string>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Reads a KITTI velodyne scan: little-endian float32 x y z intensity. Invalid points are dropped
/// and counted. Throws InputError where the file is missing, its size is no multiple of 16, its
/// numbers are of another layout (see CheckFourFloats), or no point is left.
PointCloud ReadVelodyne(const std::filesystem::path& path, DroppedPoints* dropped);

/// Gives the points of a scan their times, from a file of one little-endian float32 (s) per point.
/// Throws InputError where it cannot be read, or has not one for each point.
void ReadPointTimes(const std::filesystem::path& path, PointCloud* cloud);

/// Where the files of a sequence of the KITTI odometry benchmark lie:
///   ROOT/sequences/SS/velodyne/NNNNNN.bin, ROOT/sequences/SS/{calib,times}.txt, ROOT/poses/SS.txt.
class KittiFiles {
 public:
  /// Throws InputError unless ROOT/sequences/SS is a folder.
  KittiFiles(std::filesystem::path root, std::string sequence);

  std::filesystem::path Scan(int frame) const;
  /// ROOT/sequences/SS/times/NNNNNN.time, which simulated sequences have.
  std::filesystem::path PointTimes(int frame) const;
  std::filesystem::path Poses() const;
  std::filesystem::path Calibration() const;
  std::filesystem::path Times() const;

 private:
  std::filesystem::path root_;
  std::string sequence_;
};

/// The poses as poses/SS.txt has them, P_i = Tr T_0^-1 T_i Tr^-1: of the camera, from poses of the
/// lidar in any world. The first is the identity; the poses must not be empty.
std::vector<SE3d> KittiPosesOf(const std::vector<SE3d>& T_world_lidar, const SE3d& Tr);

/// Tr of a KITTI calib.txt: p_camera = Tr p_lidar. Throws InputError.
SE3d ReadKittiCalibration(const std::filesystem::path& path);

/// All rows of a KITTI pose file (3x4 row-major, camera frame). Throws InputError.
std::vector<SE3d> ReadKittiPoses(const std::filesystem::path& path);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_KITTI_H_
