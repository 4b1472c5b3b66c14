// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_KITTI_H_
#define ICPSCAPE_SRC_IO_KITTI_H_

#include <filesystem>
#include <string>
#include <vector>

#include "src/cloud/point_cloud.h"

namespace icpscape {

/// Reads a KITTI velodyne scan: little-endian float32 x y z intensity. Invalid points are dropped
/// and counted. Throws InputError where the file is missing, its size is no multiple of 16, or no
/// point is left.
PointCloud ReadVelodyne(const std::filesystem::path& path, DroppedPoints* dropped);

/// Turns every point about the horizontal axis across its line of sight by this angle (upwards if
/// positive): users of KITTI correct the HDL-64's elevation calibration so, by about 0.2 degrees.
void CorrectElevation(double angle_deg, PointCloud* cloud);

/// One sequence of the KITTI odometry benchmark:
///   ROOT/sequences/SS/velodyne/NNNNNN.bin, ROOT/sequences/SS/calib.txt, ROOT/poses/SS.txt.
/// Reading is lazy: a sequence without poses can still serve scans.
class KittiSequence {
 public:
  /// Throws InputError unless ROOT/sequences/SS is a folder.
  KittiSequence(std::filesystem::path root, std::string sequence);

  std::filesystem::path ScanPath(int frame) const;
  std::filesystem::path PosesPath() const;
  std::filesystem::path CalibrationPath() const;

  /// Ground truth T_to_from of the lidar, p_to = T p_from: Tr^-1 P_to^-1 P_from Tr. Throws
  /// InputError where calib.txt or the rows of the pose file are missing or malformed.
  SE3d RelativeMotion(int to, int from) const;

  /// All poses of the lidar, T_first_i in the frame of the first: Tr^-1 P_0^-1 P_i Tr.
  std::vector<SE3d> LidarPoses() const;

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
