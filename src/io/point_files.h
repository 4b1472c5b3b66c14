// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_POINT_FILES_H_
#define ICPSCAPE_SRC_IO_POINT_FILES_H_

#include <filesystem>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Reads a cloud by the file's extension: .bin (KITTI), .pcd or .ply (through PCL; fields x y z,
/// intensity if there is one). Invalid points are dropped and counted. Throws InputError.
PointCloud ReadPointFile(const std::filesystem::path& path, DroppedPoints* dropped);

/// Writes x y z (and intensity, if the cloud has it) as binary .ply, through PCL. The file appears
/// whole or not at all. Throws InputError where it cannot be written.
void WritePly(const std::filesystem::path& path, const PointCloud& cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_POINT_FILES_H_
