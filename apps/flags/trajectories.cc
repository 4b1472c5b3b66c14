// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/trajectories.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/run/flag.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Input: trajectories");

DEFINE_string(estimate, "",
              "Estimated trajectories, separated by commas: KITTI's format (12 columns) or TUM's "
              "(timestamp tx ty tz qx qy qz qw).");
static const icpscape::FlagMark estimate_mark(&FLAGS_estimate, icpscape::kShown);
DEFINE_string(ground_truth, "", "True trajectories, one for each --estimate, in either format.");
static const icpscape::FlagMark ground_truth_mark(&FLAGS_ground_truth, icpscape::kShown);
DEFINE_string(
    kitti_root, "",
    "Or: folder of the KITTI poses: the truth is ROOT/poses/SS.txt for each of --sequences.");
static const icpscape::FlagMark kitti_root_mark(&FLAGS_kitti_root, icpscape::kAside);
DEFINE_string(sequences, "", "With --kitti_root: the sequences that were estimated, as in 00,07.");
static const icpscape::FlagMark sequences_mark(&FLAGS_sequences, icpscape::kShown);
DEFINE_string(frames, "",
              "Frames of the truth that were estimated, as in 0:99. Without it: all, or, where "
              "the estimates have timestamps, those of the same times.");
DEFINE_string(calib, "",
              "calib.txt, one for all or one for each --estimate: needed where the estimates are "
              "poses of the lidar and the truth has poses of the camera.");
DEFINE_double(max_time_difference_s, 0.01,
              "Where both have timestamps, poses are paired whose times differ by at most this "
              "(s).");
DEFINE_int32(rpe_frames, 1, "Number of frames over which the relative pose error is taken.");

namespace icpscape {
namespace {

// What tables call the estimates: the files' names without folders while that tells them apart.
std::vector<std::string> NamesOf(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  for (const std::string& path : paths) {
    names.push_back(std::filesystem::path(path).stem().string());
  }
  const bool are_unique = std::set<std::string>(names.begin(), names.end()).size() == names.size();
  return are_unique ? names : paths;
}

std::vector<std::string> ListFromFlag(const std::string& flag, const std::string& value) {
  std::vector<std::string> parts = Split(value);
  const auto commas = static_cast<std::size_t>(std::count(value.begin(), value.end(), ','));
  RequireFlag(value.empty() || parts.size() == commas + 1, flag, value,
              "names separated by single commas");
  return parts;
}

// The list of a flag that must have one entry for each estimate.
std::vector<std::string> ListForEach(const std::string& flag, const std::string& value,
                                     std::size_t count) {
  std::vector<std::string> parts = ListFromFlag(flag, value);
  RequireFlag(parts.size() == count, flag, value, "one for each --estimate");
  return parts;
}

}  // namespace

std::vector<TrajectoryFiles> TrajectoriesFromFlags() {
  if (FLAGS_estimate.empty()) {
    throw UsageError("no --estimate: expected the file of a trajectory, or several.");
  }
  const bool from_kitti = !FLAGS_kitti_root.empty();
  if (from_kitti == !FLAGS_ground_truth.empty()) {
    throw UsageError(
        "expected --ground_truth=FILE, or --kitti_root=DIR --sequences=SS, and not both.");
  }
  RequireFlag(from_kitti || FLAGS_sequences.empty(), "sequences", FLAGS_sequences,
              "--kitti_root with it");
  const std::vector<std::string> estimates = ListFromFlag("estimate", FLAGS_estimate);
  const std::size_t count = estimates.size();
  const std::vector<std::string> names =
      from_kitti ? ListForEach("sequences", FLAGS_sequences, count) : NamesOf(estimates);
  const std::vector<std::string> truths =
      from_kitti ? names : ListForEach("ground_truth", FLAGS_ground_truth, count);
  std::vector<std::string> calibrations = ListFromFlag("calib", FLAGS_calib);
  if (calibrations.size() <= 1) {  // None for all of them, or the same for all.
    calibrations.resize(count, FLAGS_calib);
  }
  RequireFlag(calibrations.size() == count, "calib", FLAGS_calib,
              "one, or one for each --estimate");
  std::vector<TrajectoryFiles> all;
  for (std::size_t i = 0; i < count; ++i) {
    TrajectoryFiles files = {names[i], estimates[i], truths[i], {}, calibrations[i]};
    if (from_kitti) {
      const std::filesystem::path root = FLAGS_kitti_root;
      files.truth = root / "poses" / (names[i] + ".txt");
      files.times = root / "sequences" / names[i] / "times.txt";
    }
    all.push_back(files);
  }
  return all;
}

FrameRange TruthFramesFromFlags() { return FrameRangeFromText(FLAGS_frames); }

double MaxTimeDifferenceFromFlags() {
  RequireFlag(FLAGS_max_time_difference_s >= 0 && std::isfinite(FLAGS_max_time_difference_s),
              "max_time_difference_s", Number(FLAGS_max_time_difference_s),
              "a time of at least 0 s");
  return FLAGS_max_time_difference_s;
}

int RpeFramesFromFlags() {
  RequireFlag(FLAGS_rpe_frames >= 1, "rpe_frames", std::to_string(FLAGS_rpe_frames), "at least 1");
  return FLAGS_rpe_frames;
}

}  // namespace icpscape
