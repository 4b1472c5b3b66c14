// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/paper.h"

#include <gflags/gflags.h>

#include <array>
#include <cstdio>
#include <iostream>

#include "apps/flags/lidar.h"
#include "apps/run/flag.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "The paper's figures");

DEFINE_string(figure, "all",
              "all or one of 00_1500, 00_100, 01_320, 01_320_improved, 01_420, 01_420_octree.");
static const icpscape::FlagMark figure_mark(&FLAGS_figure, icpscape::kShown);
DEFINE_string(
    kitti_root, "",
    "Folder of the KITTI odometry data (with sequences/ and poses/): draws the paper's own "
    "frames. Without it: simulated scenes of --seed, with the motion of these frames.");
static const icpscape::FlagMark kitti_root_mark(&FLAGS_kitti_root, icpscape::kAside);
DEFINE_int32(straight_frame, 1500,
             "KITTI 00 scan of figure 00_1500; 15 is a substitute where the paper's is missing.");
static const icpscape::FlagMark straight_frame_mark(&FLAGS_straight_frame, icpscape::kShown);
DEFINE_int32(turn_frame, 100,
             "KITTI 00 scan of figure 00_100; 95 is a substitute where the paper's is missing.");
static const icpscape::FlagMark turn_frame_mark(&FLAGS_turn_frame, icpscape::kShown);
DEFINE_int32(samples, 100, "Poses along the path, u from -1 to 2, both ends included.");
static const icpscape::FlagMark samples_mark(&FLAGS_samples, icpscape::kShown);

namespace icpscape {
namespace {

// The scans of KITTI that a figure needs and that are not on disk.
std::vector<std::string> MissingScans(const Figure& figure) {
  std::vector<std::string> missing;
  const std::filesystem::path root = FLAGS_kitti_root;
  for (const int frame : {FrameFromFlags(figure) - 1, FrameFromFlags(figure)}) {
    std::array<char, 16> name;
    std::snprintf(name.data(), name.size(), "%06d.bin", frame);
    const auto scan = root / "sequences" / figure.sequence / "velodyne" / name.data();
    if (!root.empty() && !std::filesystem::exists(scan)) {
      missing.push_back(scan.string());
    }
  }
  return missing;
}

}  // namespace

std::vector<Figure> FiguresFromFlags() {
  std::vector<Figure> figures;
  for (const Figure& figure : FiguresFromName(FLAGS_figure)) {
    const std::vector<std::string> missing = MissingScans(figure);
    if (missing.empty()) {
      figures.push_back(figure);
    } else {
      std::cout << "figure " << figure.name << " is skipped: " << Join(missing, " and ")
                << " not found.\n";
    }
  }
  if (figures.empty()) {
    throw InputError(FLAGS_kitti_root +
                     ": no figure's scans are there; expected those named above.");
  }
  return figures;
}

CurveOptions PaperCurveFromFlags() {
  CurveOptions options;
  options.samples = FLAGS_samples;
  options.threads = ThreadsFromFlags();
  options.Check();
  return options;
}

std::filesystem::path PaperScansFromFlags() { return FLAGS_kitti_root; }

int FrameFromFlags(const Figure& figure) {
  RequireFlag(FLAGS_straight_frame >= 2, "straight_frame", std::to_string(FLAGS_straight_frame),
              "at least 2, for two scans before it");
  RequireFlag(FLAGS_turn_frame >= 2, "turn_frame", std::to_string(FLAGS_turn_frame),
              "at least 2, for two scans before it");
  if (figure.name == "00_1500") {
    return FLAGS_straight_frame;
  }
  return figure.name == "00_100" ? FLAGS_turn_frame : figure.frame;
}

std::string PaperSourceText() {
  if (FLAGS_kitti_root.empty()) {
    return "the simulated scenes, seed " + std::to_string(SeedFromFlags());
  }
  return "KITTI's scans (straight street 00/" + std::to_string(FLAGS_straight_frame) +
         ", turn 00/" + std::to_string(FLAGS_turn_frame) + ")";
}

}  // namespace icpscape
