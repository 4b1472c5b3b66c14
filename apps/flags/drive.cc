// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/drive.h"

#include <gflags/gflags.h>

#include <iostream>

#include "apps/flags/frames.h"
#include "apps/flags/sequence.h"
#include "apps/run/flag.h"
#include "icpscape/io/sequences.h"

static const icpscape::FlagGroup group(__FILE__, "Input: times of a drive");

DEFINE_string(timestamps, "",
              "Times of the scans, instead of those beside them or in their names: a file with a "
              "line for each scan, which begins with seconds (as in TUM's trajectories), with a "
              "whole number of 13, 16 or 19 digits (milli-, micro- or nanoseconds), or with a date "
              "and time as KITTI has them.");
static const icpscape::FlagMark timestamps_mark(&FLAGS_timestamps, icpscape::kAside);

namespace icpscape {

void CheckDriveFlags() {
  CheckSequenceFlags();
  RequireFlag(FLAGS_timestamps.empty() || !SceneIsGiven(), "timestamps", FLAGS_timestamps,
              "--scans or --kitti_root with it: scenes have their times");
  FramesFromFlags();
}

ScanSequence DriveFromFlags(Manifest* manifest) {
  ScanSequence drive = SequenceFromFlags(manifest);
  if (!FLAGS_timestamps.empty()) {
    SetTimesFromFile(FLAGS_timestamps, &drive);
    manifest->AddInput(FLAGS_timestamps);
  }
  drive = drive.Frames(FramesFromFlags());
  if (ReverseFromFlags()) {
    drive.Reverse();
  }
  std::cout << drive.title << ": " << drive.scans.size() << " scans, " << drive.scans.front().name
            << " to " << drive.scans.back().name
            << (drive.T_world_lidar.empty() ? ", no ground truth" : "") << std::endl;
  return drive;
}

}  // namespace icpscape
