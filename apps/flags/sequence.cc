// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/sequence.h"

#include <gflags/gflags.h>

#include <iostream>

#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/io/kitti.h"
#include "src/io/trajectory.h"

static const icpscape::FlagGroup group(__FILE__, "Input: a drive");

DEFINE_string(kitti_root, "", "Folder of the KITTI odometry data (with sequences/ and poses/).");
static const icpscape::FlagMark kitti_root_mark(&FLAGS_kitti_root, icpscape::kAside);
DEFINE_string(sequence, "00", "KITTI sequence, with --kitti_root.");
static const icpscape::FlagMark sequence_mark(&FLAGS_sequence, icpscape::kShown);
DEFINE_string(scans, "",
              "Or: a folder of .bin, .pcd or .ply scans, or a raw drive of KITTI's (a folder with "
              "velodyne_points/).");
static const icpscape::FlagMark scans_mark(&FLAGS_scans, icpscape::kAside);
DEFINE_string(
    ground_truth, "",
    "With --scans: trajectory of the lidar, KITTI's or TUM's format, a pose for each scan "
    "of the folder.");
static const icpscape::FlagMark ground_truth_mark(&FLAGS_ground_truth, icpscape::kAside);
DEFINE_string(frames, "", "First and last scan, as in 0:99; none is all.");
DEFINE_bool(reverse, false, "Drive backwards: the last scan comes first.");
static const icpscape::FlagMark reverse_mark(&FLAGS_reverse, icpscape::kShown);

namespace icpscape {

void CheckSequenceFlags() {
  if (FLAGS_kitti_root.empty() == FLAGS_scans.empty()) {
    throw UsageError("expected --kitti_root=DIR --sequence=SS, or --scans=DIR, and not both.");
  }
  RequireFlag(FLAGS_ground_truth.empty() || !FLAGS_scans.empty(), "ground_truth",
              FLAGS_ground_truth, "--scans with it (KITTI's sequences have their poses)");
  FrameRangeFromText(FLAGS_frames);
}

ScanSequence SequenceFromFlags(Manifest* manifest) {
  const FrameRange frames = FrameRangeFromText(FLAGS_frames);
  ScanSequence sequence;
  if (!FLAGS_kitti_root.empty()) {
    sequence = OpenKittiSequence(FLAGS_kitti_root, FLAGS_sequence, frames);
    const KittiSequence kitti(FLAGS_kitti_root, FLAGS_sequence);
    for (const std::filesystem::path& path : {kitti.CalibrationPath(), kitti.PosesPath()}) {
      if (std::filesystem::exists(path)) {
        manifest->AddInput(path);
      }
    }
  } else {
    sequence = OpenScanFolder(FLAGS_scans, frames);
    if (!FLAGS_ground_truth.empty()) {
      const std::vector<SE3d> poses = ReadTrajectory(FLAGS_ground_truth).T_world_body;
      const std::size_t all = OpenScanFolder(FLAGS_scans).scans.size();
      if (poses.size() != all) {
        throw InputError(FLAGS_ground_truth + ": " + std::to_string(poses.size()) +
                         " poses; expected one for each of the " + std::to_string(all) +
                         " scans in " + FLAGS_scans + ".");
      }
      const auto begin = poses.begin() + frames.first;
      sequence.T_world_lidar = {begin, begin + static_cast<std::ptrdiff_t>(sequence.scans.size())};
      manifest->AddInput(FLAGS_ground_truth);
    }
  }
  if (FLAGS_reverse) {
    sequence.Reverse();
  }
  std::cout << sequence.title << ": " << sequence.scans.size() << " scans, "
            << sequence.scans.front().filename().string() << " to "
            << sequence.scans.back().filename().string()
            << (sequence.T_world_lidar.empty() ? ", no ground truth" : "")
            << (sequence.times_are_measured ? "" : ", no times: 10 Hz") << std::endl;
  return sequence;
}

}  // namespace icpscape
