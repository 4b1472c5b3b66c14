// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_SEQUENCE_H_
#define ICPSCAPE_APPS_FLAGS_SEQUENCE_H_

#include "src/io/manifest.h"
#include "src/io/scan_sequence.h"

namespace icpscape {

/// Refuses what can be seen to be wrong before any file is read. Throws UsageError.
void CheckSequenceFlags();

/// The drive of --kitti_root --sequence or --scans, of it --frames, and --reverse; for --scans with
/// the truth of --ground_truth. Prints what there is and records the small inputs. Throws
/// InputError.
ScanSequence SequenceFromFlags(Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_SEQUENCE_H_
