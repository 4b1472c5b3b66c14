// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_DRIVE_H_
#define ICPSCAPE_APPS_FLAGS_DRIVE_H_

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/io/manifest.h"

namespace icpscape {

/// Refuses flags that are wrong before any file is read. Throws UsageError.
void CheckDriveFlags();

/// The --frames of the sequence of the flags, with the times of --timestamps where it is given,
/// turned around under --reverse. Prints what there is
/// and records the small inputs. Throws InputError.
ScanSequence DriveFromFlags(Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_DRIVE_H_
