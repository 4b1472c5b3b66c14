// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/drive.h"

#include <gflags/gflags.h>

#include <iostream>

#include "apps/flags/frames.h"
#include "apps/flags/sequence.h"

namespace icpscape {

void CheckDriveFlags() {
  CheckSequenceFlags();
  FramesFromFlags();
}

ScanSequence DriveFromFlags(Manifest* manifest) {
  ScanSequence drive = SequenceFromFlags(manifest).Frames(FramesFromFlags());
  if (ReverseFromFlags()) {
    drive.Reverse();
  }
  std::cout << drive.title << ": " << drive.scans.size() << " scans, " << drive.scans.front().name
            << " to " << drive.scans.back().name
            << (drive.T_world_lidar.empty() ? ", no ground truth" : "")
            << (drive.times_are_measured ? "" : ", no times: 10 Hz") << std::endl;
  return drive;
}

}  // namespace icpscape
