// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_PAPER_H_
#define ICPSCAPE_APPS_FLAGS_PAPER_H_

#include <filesystem>
#include <string>
#include <vector>

#include "icpscape/landscape/curve.h"
#include "icpscape/paper/figures.h"

namespace icpscape {

/// The figures of --figure. With --kitti_root only those whose scans are on disk; the others are
/// named. Throws UsageError, and InputError where none is left.
std::vector<Figure> FiguresFromFlags();

/// --samples and --threads. Throws UsageError.
CurveOptions PaperCurveFromFlags();

/// --kitti_root; empty where scans are to be simulated.
std::filesystem::path PaperScansFromFlags();

/// The scan of KITTI that a figure is drawn of: the paper's, or that of --straight_frame or
/// --turn_frame. Throws UsageError.
int FrameFromFlags(const Figure& figure);

/// What the claims are checked on: "the simulated scenes, seed 1".
std::string PaperSourceText();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_PAPER_H_
