// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_PAIR_H_
#define ICPSCAPE_APPS_FLAGS_PAIR_H_

#include <string>
#include <vector>

#include "apps/run/run_flags.h"
#include "icpscape/cloud/scan_pair.h"
#include "icpscape/io/manifest.h"
#include "icpscape/preparation/prepared_pair.h"

namespace icpscape {

/// Refuses flags that are wrong before any file is read, also where one of the metrics cannot use
/// voxels, or a ground truth is needed and the input has none. Throws UsageError.
void CheckPairFlags(const std::vector<std::string>& metrics, bool needs_ground_truth);

/// The pair of --source --target, or two frames of the sequence of the flags; turned around under
/// --reverse. Prints what was read and dropped, and records inputs and timings. Throws InputError.
ScanPair ReadPair(Manifest* manifest);

/// --initial: the pose at u = 0, where register starts, as the pair's poses are. Throws UsageError
/// where the predicted pose is unknown, InputError where its file cannot be read.
SE3d InitialPose(const ScanPair& pair, Manifest* manifest);

/// Prepares the pair, whose clouds it takes, for the metrics, the rejections of the flags and the
/// check of the ground truth. Prints and records what was thinned, points without a normal and
/// features. Throws InputError.
PreparedPair PrepareFromFlags(const std::vector<std::string>& metrics, ScanPair* pair,
                              Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_PAIR_H_
