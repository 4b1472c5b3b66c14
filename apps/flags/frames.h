// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_FRAMES_H_
#define ICPSCAPE_APPS_FLAGS_FRAMES_H_

#include "icpscape/cloud/scan_sequence.h"

namespace icpscape {

/// --frames. Throws UsageError.
FrameRange FramesFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_FRAMES_H_
