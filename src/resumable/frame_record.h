// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_RESUMABLE_FRAME_RECORD_H_
#define ICPSCAPE_SRC_RESUMABLE_FRAME_RECORD_H_

#include <string>

#include "icpscape/odometry/odometry.h"

namespace icpscape {

/// One scan's line in the journal of an odometry.
struct FrameRecord {
  FrameResult result;
  std::string scan_sha256;  ///< Of the scan's file.
  double read_s = 0;        ///< Time to read the file and its hash, ...
  double odometry_s = 0;    ///< ... and to prepare, register and map the scan.
};

/// All numbers read back exactly.
std::string FormatFrameRecord(const FrameRecord& record);
/// Throws InputError naming `place` for a text that FormatFrameRecord did not write.
FrameRecord ParseFrameRecord(const std::string& text, const std::string& place);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_RESUMABLE_FRAME_RECORD_H_
