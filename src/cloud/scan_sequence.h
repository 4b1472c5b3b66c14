// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_SCAN_SEQUENCE_H_
#define ICPSCAPE_SRC_CLOUD_SCAN_SEQUENCE_H_

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "icpscape/cloud/scan_pair.h"

namespace icpscape {

/// Seconds between two scans, where nothing else is known and in simulated drives.
inline constexpr double kScanPeriodS = 0.1;

/// One scan of a sequence. It is read, or simulated, when it is asked for.
struct Scan {
  std::string name;            ///< For messages and tables: "000095.bin".
  std::filesystem::path file;  ///< Empty where the scan is simulated.
  /// Says how many points were dropped. Throws InputError.
  std::function<PointCloud(DroppedPoints*)> read;
  std::filesystem::path times_file =
      {};  ///< Of the times of its points; empty where `file` has all.

  /// For messages: the path of the file, or the name.
  std::string Place() const { return file.empty() ? name : file.string(); }
};

/// Frames of a sequence; both ends belong to it.
struct FrameRange {
  int first = 0;
  int last = -1;  ///< -1: to the end.
};
/// From "FIRST:LAST", or all from "". Throws UsageError.
FrameRange FrameRangeFromText(const std::string& text);

/// Scans taken one after the other, with their times and true poses where these are known. KITTI's
/// sequences, raw drives, folders of files and simulated drives all become one. Frame i is
/// scans[i]; a pair of scans is two frames.
struct ScanSequence {
  std::string title;            ///< For figures: "KITTI 07".
  std::filesystem::path place;  ///< For messages: where the scans lie.
  std::vector<Scan> scans;
  /// Seconds, one per scan, increasing; NaN for a scan without a time.
  std::vector<double> times_s;
  bool times_are_measured = false;  ///< Else they are made up: a count of kScanPeriodS.
  std::string times_from;           ///< For people, where they come from: "times.txt".
  /// Ground truth: the pose of the lidar at each frame, in any world. Empty where there is none; it
  /// may end before the scans do.
  std::vector<SE3d> T_world_lidar;
  bool truth_is_exact = false;  ///< Simulated.
  /// KITTI's files hold poses of the camera: those, and Tr of calib.txt, p_camera = Tr p_lidar.
  std::vector<SE3d> T_world_camera;
  std::optional<SE3d> T_camera_lidar;
  std::filesystem::path times_file, poses_file;  ///< For messages.
  std::vector<std::filesystem::path> inputs;     ///< The small files that were read.

  /// The frames of the range, all of them complete: every scan is there, has a time, and, where
  /// there is a ground truth, a pose. Throws InputError naming what is missing.
  ScanSequence Frames(const FrameRange& range) const;

  /// Turns the sequence around: the last scan comes first. Time still goes forwards: from the same
  /// first time to the same last one, with the gaps in turned order; the times of points have the
  /// other sign.
  void Reverse();

  /// "times.txt, 1 gap of 0.5 s": where the times come from, and spans between scans that are more
  /// than one and a half times as long as usual (the median).
  std::string TimesText() const;

  /// T_to_from of the lidar by the ground truth, where there is one. Where the files hold poses of
  /// the camera: Tr^-1 P_to^-1 P_from Tr. Throws InputError where a frame has no pose.
  std::optional<SE3d> Motion(int to, int from) const;

  /// The scan `source`, to be registered to the scan `target`; with the ground truth and, where
  /// both have a frame before, the predicted pose: the motion between these, for the time between
  /// the two (see MotionDuring). `read` reads a scan by its role, "source" or "target". Throws
  /// InputError where there is no such frame.
  ScanPair Pair(int source, int target,
                const std::function<PointCloud(const char* role, const Scan&)>& read) const;
  /// The same, read silently.
  ScanPair Pair(int source, int target) const;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_SCAN_SEQUENCE_H_
