// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/frames.h"

#include <gflags/gflags.h>

#include "apps/run/flag.h"
#include "icpscape/common/error.h"

static const icpscape::FlagGroup group(__FILE__, "Input: part of a drive");

DEFINE_string(frames, "", "First and last frame of the drive, as in 0:99; empty: the whole drive.");

namespace icpscape {

FrameRange FramesFromFlags() {
  try {
    return FrameRangeFromText(FLAGS_frames);
  } catch (const UsageError& error) {
    throw UsageError(std::string("--") + error.what());
  }
}

}  // namespace icpscape
