// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_KITTI_WRITER_H_
#define ICPSCAPE_SRC_IO_KITTI_WRITER_H_

#include <filesystem>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// All of these throw InputError where the file cannot be written; it appears whole or not at all.

/// KITTI's velodyne/NNNNNN.bin: little-endian float32 x y z intensity (0 where there is none).
void WriteVelodyne(const std::filesystem::path& path, const PointCloud& cloud);

/// SemanticKITTI's labels/NNNNNN.label: little-endian uint32 per point, semantic class in the lower
/// 16 bits, instance in the upper. Throws UsageError where the points have no labels.
void WriteLabels(const std::filesystem::path& path, const PointCloud& cloud);

/// rings/NNNNNN.ring: one byte per point, the ring it was measured by, 0 the uppermost. Throws
/// UsageError where the points have no rings.
void WriteRings(const std::filesystem::path& path, const PointCloud& cloud);

/// times/NNNNNN.time: little-endian float32 per point, when it was measured (s). Throws UsageError
/// where the points have no times.
void WritePointTimes(const std::filesystem::path& path, const PointCloud& cloud);

/// poses/SS.txt from lidar poses: rows P_i = Tr T_0^-1 T_i Tr^-1, 3x4 row-major, camera frame, the
/// first one the identity; all digits.
void WriteKittiPoses(const std::filesystem::path& path, const std::vector<SE3d>& T_world_lidar,
                     const SE3d& Tr);

/// calib.txt with the one line that a scan needs, Tr: p_camera = Tr p_lidar.
void WriteKittiCalibration(const std::filesystem::path& path, const SE3d& Tr);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_KITTI_WRITER_H_
