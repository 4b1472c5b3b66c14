// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_POINT_FILES_H_
#define ICPSCAPE_SRC_IO_POINT_FILES_H_

#include <filesystem>
#include <string>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// The extension of a file that ReadPointFile takes, in lower case; "" for any other file.
std::string PointFileKind(const std::filesystem::path& path);

/// Reads a cloud by the file's extension, in upper or lower case: .bin (KITTI's), .pcd, .ply,
/// .npy, and .csv, .txt and .xyz (see ReadTextPoints). See CloudOf for the fields that are used and
/// the points that are dropped. Throws InputError.
PointCloud ReadPointFile(const std::filesystem::path& path, DroppedPoints* dropped);

/// Writes x y z (and intensity, if the cloud has it) as binary .ply, in the coordinates of the
/// user: floats, or doubles where the cloud has an origin. The file appears whole or not at all.
/// Throws InputError where it cannot be written.
void WritePly(const std::filesystem::path& path, const PointCloud& cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_POINT_FILES_H_
