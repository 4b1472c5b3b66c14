// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_TRAJECTORY_H_
#define ICPSCAPE_SRC_IO_TRAJECTORY_H_

#include <filesystem>
#include <vector>

#include "icpscape/cloud/trajectory.h"

namespace icpscape {

/// Reads either format; the columns of the first row decide:
///   12, KITTI: the upper 3x4 of T_world_body, row-major; no times;
///    8, TUM: "timestamp tx ty tz qx qy qz qw", seconds and metres; lines that begin with # are
///       comments; times must increase.
/// Throws InputError FILE:LINE where a row has other columns, is no rigid motion, is not finite or
/// has a coordinate beyond 1e9 m, and where there is no pose or no regular file.
Trajectory ReadTrajectory(const std::filesystem::path& path);

/// KITTI's format, all poses unchanged. Translations read back exactly, rotations to rounding (they
/// are normalised on reading). Throws InputError where the file cannot be written.
void WriteKittiTrajectory(const std::filesystem::path& path, const std::vector<SE3d>& T_world_body);

/// TUM's format, as above. Throws UsageError where the trajectory has no times.
void WriteTumTrajectory(const std::filesystem::path& path, const Trajectory& trajectory);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_TRAJECTORY_H_
