// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_SEQUENCE_H_
#define ICPSCAPE_APPS_FLAGS_SEQUENCE_H_

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/io/manifest.h"

namespace icpscape {

/// Whether --scene, --kitti_root or --scans names a sequence.
bool SequenceIsGiven();

/// Whether --scene is given, and names three scans rather than a drive.
bool SceneIsGiven();
bool SceneOfThreeScans();

/// Refuses flags that are wrong before any file is read: it must be one of --scene, --kitti_root
/// and --scans. Throws UsageError.
void CheckSequenceFlags();

/// The sequence with all its frames, and the truth of --ground_truth for --scans. Records the small
/// inputs. Throws InputError.
ScanSequence SequenceFromFlags(Manifest* manifest);

/// Whether the sequence has a ground truth, as far as the flags tell.
bool FlagsHaveGroundTruth();

/// --ground_truth; empty where it is not given.
const std::string& GroundTruthFile();

/// --reverse.
bool ReverseFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_SEQUENCE_H_
