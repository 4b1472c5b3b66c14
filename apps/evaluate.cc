// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "apps/reports/trajectory.h"
#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/common/text.h"
#include "src/io/kitti.h"
#include "src/io/output.h"
#include "src/io/sequences.h"

DEFINE_string(estimate, "",
              "Estimated trajectories, separated by commas: KITTI's format (12 columns) or TUM's "
              "(timestamp tx ty tz qx qy qz qw).");
DEFINE_string(ground_truth, "", "The true ones, as many, in either format.");
DEFINE_string(kitti_root, "", "Or: folder of the KITTI poses, ROOT/poses/SS.txt, ...");
DEFINE_string(sequences, "", "... and the sequences that were estimated, as in 00,07.");
DEFINE_string(frames, "",
              "Frames of the truth that were estimated, as in 0:99; none is all, or, where the "
              "estimates have timestamps, those of the same times.");
DEFINE_string(calib, "",
              "If given, the estimates are poses of the lidar and the truth of the camera: they "
              "are compared as the camera's, through this calib.txt, one or one per estimate.");
DEFINE_double(max_time_difference_s, 0.01,
              "Where both have timestamps, poses are paired whose times differ by at most this "
              "(s).");
DEFINE_int32(rpe_frames, 1, "Frames over which the relative pose error is taken.");
DEFINE_string(out, "out/evaluate", "Folder for the results.");

namespace icpscape {
namespace {

struct Files {
  std::vector<std::string> names;
  std::vector<std::string> estimates;
  std::vector<std::string> truths;
  std::vector<std::string> calibrations;  // None, or one each.
};

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

Files FilesFromFlags() {
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
  Files files;
  files.estimates = ListFromFlag("estimate", FLAGS_estimate);
  const auto as_many = [&](std::size_t count) { return count == files.estimates.size(); };
  const std::string expected = "one for each --estimate";
  if (from_kitti) {
    files.names = ListFromFlag("sequences", FLAGS_sequences);
    RequireFlag(as_many(files.names.size()), "sequences", FLAGS_sequences, expected);
    for (const std::string& sequence : files.names) {
      files.truths.push_back(
          (std::filesystem::path(FLAGS_kitti_root) / "poses" / (sequence + ".txt")).string());
    }
  } else {
    files.names = NamesOf(files.estimates);
    files.truths = ListFromFlag("ground_truth", FLAGS_ground_truth);
    RequireFlag(as_many(files.truths.size()), "ground_truth", FLAGS_ground_truth, expected);
  }
  files.calibrations = ListFromFlag("calib", FLAGS_calib);
  if (files.calibrations.size() == 1) {
    files.calibrations.resize(files.estimates.size(), files.calibrations[0]);
  }
  RequireFlag(files.calibrations.empty() || as_many(files.calibrations.size()), "calib",
              FLAGS_calib, "one, or " + expected);
  return files;
}

// The truth, of it --frames; for --kitti_root with the times of sequences/SS/times.txt, if it is
// there.
Trajectory Truth(const Files& files, std::size_t i) {
  Trajectory truth = ReadTrajectory(files.truths[i]);
  std::vector<SE3d>& poses = truth.T_world_body;
  if (!FLAGS_kitti_root.empty() && truth.times_s.empty()) {
    const std::filesystem::path path =
        std::filesystem::path(FLAGS_kitti_root) / "sequences" / files.names[i] / "times.txt";
    truth.times_s = ReadTimes(path);
    if (!truth.times_s.empty() && truth.times_s.size() != poses.size()) {
      throw InputError(path.string() + ": " + std::to_string(truth.times_s.size()) +
                       " times; expected one for each of " + std::to_string(poses.size()) +
                       " poses.");
    }
    const auto blank = std::find_if(truth.times_s.begin(), truth.times_s.end(),
                                    [](double time) { return std::isnan(time); });
    if (blank != truth.times_s.end()) {
      throw InputError(path.string() + ":" + std::to_string(blank - truth.times_s.begin() + 1) +
                       ": a blank line; expected a time.");
    }
  }
  const FrameRange frames = FrameRangeFromText(FLAGS_frames);
  const int count = static_cast<int>(poses.size());
  if (frames.first >= count || frames.last >= count) {
    throw InputError(files.truths[i] + ": " + std::to_string(count) +
                     " poses; expected --frames within 0:" + std::to_string(count - 1) + ".");
  }
  const int end = frames.last < 0 ? count : frames.last + 1;
  poses = {poses.begin() + frames.first, poses.begin() + end};
  if (!truth.times_s.empty()) {
    truth.times_s = {truth.times_s.begin() + frames.first, truth.times_s.begin() + end};
  }
  return truth;
}

NamedTrajectory Load(const Files& files, std::size_t i, Manifest* manifest) {
  Trajectory estimate = ReadTrajectory(files.estimates[i]);
  const Trajectory truth = Truth(files, i);
  manifest->AddInput(files.estimates[i]);
  manifest->AddInput(files.truths[i]);
  if (!files.calibrations.empty()) {
    const SE3d Tr = ReadKittiCalibration(files.calibrations[i]);
    manifest->AddInput(files.calibrations[i]);
    for (SE3d& T : estimate.T_world_body) {
      T = Tr * T * Tr.Inverse();
    }
  }
  NamedTrajectory trajectory;
  trajectory.name = files.names[i];
  try {
    trajectory.pair = Associate(truth, estimate, FLAGS_max_time_difference_s);
  } catch (const InputError& error) {
    throw InputError(files.estimates[i] + " and " + files.truths[i] + ": " + error.what());
  }
  std::cout << trajectory.name << ": " << trajectory.pair.truth.size() << " pairs of poses ("
            << estimate.T_world_body.size() << " estimated, " << truth.T_world_body.size()
            << " true), " << Fixed(PathLengths(trajectory.pair.truth).back(), 1) << " m\n";
  return trajectory;
}

void Evaluate() {
  const Files files = FilesFromFlags();
  RequireFlag(FLAGS_max_time_difference_s >= 0 && std::isfinite(FLAGS_max_time_difference_s),
              "max_time_difference_s", Number(FLAGS_max_time_difference_s),
              "a time of at least 0 s");
  FrameRangeFromText(FLAGS_frames);
  RequireFlag(FLAGS_rpe_frames >= 1, "rpe_frames", std::to_string(FLAGS_rpe_frames), "at least 1");
  RequireFlag(!FLAGS_out.empty(), "out", FLAGS_out, "a folder");
  const std::filesystem::path out = FLAGS_out;
  PrepareOutputFolder(out);
  std::filesystem::remove(out / "manifest.json");  // Written last: the mark of a finished run.
  Manifest manifest(AppName());
  RecordFlags(&manifest);
  std::vector<NamedTrajectory> trajectories;
  for (std::size_t i = 0; i < files.estimates.size(); ++i) {
    trajectories.push_back(Load(files, i, &manifest));
  }
  manifest.AddTiming("read");
  std::cout << std::endl;  // Before printf writes.
  ReportTrajectoryErrors(trajectories, FLAGS_rpe_frames, out, &manifest);
  manifest.AddTiming("evaluate");
  const bool drawn =
      DrawTrajectories(trajectories, trajectories.size() == 1 ? trajectories[0].name : "", out);
  manifest.AddTiming("figures");
  manifest.Write(out / "manifest.json");
  std::cout << "\nwritten: " << (out / "errors.csv").string()
            << ", summary.csv, pose_errors.csv, trajectory.csv"
            << (drawn ? ", trajectory.svg, trajectory.png" : "") << ", manifest.json\n";
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv,
                          "measures estimated trajectories against the truth: KITTI's t_err and "
                          "r_err over 100 to 800 m, ATE and RPE.",
                          icpscape::Evaluate);
}
