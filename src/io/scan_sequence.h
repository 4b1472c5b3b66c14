// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_SCAN_SEQUENCE_H_
#define ICPSCAPE_SRC_IO_SCAN_SEQUENCE_H_

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "residuals/lie.h"

namespace icpscape {

/// Which frames of a drive; both ends belong to it.
struct FrameRange {
  int first = 0;
  int last = -1;  ///< -1: to the end.
};
/// From "FIRST:LAST", or all from "". Throws UsageError.
FrameRange FrameRangeFromText(const std::string& text);

/// The scans of a drive in their order, and what is known about them.
struct ScanSequence {
  std::string title;                         ///< For figures: "KITTI 07".
  std::vector<std::filesystem::path> scans;  ///< What ReadPointFile takes.
  std::vector<double> times_s;               ///< One per scan, increasing.
  bool times_are_measured = false;           ///< Else they are made up: 10 scans a second.
  /// Ground truth, one per scan, in any world; empty where there is none.
  std::vector<SE3d> T_world_lidar;
  /// Tr of KITTI's calib.txt, p_camera = Tr p_lidar: its files hold poses of the camera.
  std::optional<SE3d> T_camera_lidar;

  /// Turns the drive around: the last scan comes first. The times stay as they are.
  void Reverse();
};

/// A file of times, one per line: increasing, NaN where a line is blank (so KITTI marks scans that
/// were lost). Seconds, or KITTI's dates and times as seconds since the month began. Nothing where
/// there is no file. Throws InputError.
std::vector<double> ReadTimes(const std::filesystem::path& path);

/// A sequence of the KITTI odometry benchmark (see KittiSequence): its scans, and its times, poses
/// and calibration where their files are there; or one that icpscape-simulate wrote. Frames are the
/// numbers of the scans. Throws InputError where a scan of the range is missing, or a file is
/// malformed or too short.
ScanSequence OpenKittiSequence(const std::filesystem::path& root, const std::string& sequence,
                               const FrameRange& frames = {});

/// A folder of .bin, .pcd or .ply files, by number where all names are numbers, else by name; or a
/// raw drive of KITTI's, with velodyne_points/data and, where it is there,
/// velodyne_points/timestamps.txt. Frames count the scans that are there from 0; the time of a raw
/// scan is the line of its number (drives can lack scans). Throws InputError where there is no
/// scan, more than one kind of file, fewer frames than asked for, or a missing or malformed time.
ScanSequence OpenScanFolder(const std::filesystem::path& folder, const FrameRange& frames = {});

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_SCAN_SEQUENCE_H_
