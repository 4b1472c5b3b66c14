// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "apps/flags/trajectories.h"
#include "apps/reports/trajectory.h"
#include "apps/run/app.h"
#include "apps/run/run.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/scan_times.h"
#include "icpscape/io/trajectory.h"

namespace icpscape {
namespace {

// The times of a truth without times of its own, from its times.txt if that is there.
void AddTimes(const std::filesystem::path& path, Trajectory* truth) {
  truth->times_s = ReadTimes(path);
  if (!truth->times_s.empty() && truth->times_s.size() != truth->T_world_body.size()) {
    throw InputError(path.string() + ": " + std::to_string(truth->times_s.size()) +
                     " times; expected one for each of " +
                     std::to_string(truth->T_world_body.size()) + " poses.");
  }
  const auto blank = std::find_if(truth->times_s.begin(), truth->times_s.end(),
                                  [](double time) { return std::isnan(time); });
  if (blank != truth->times_s.end()) {
    throw InputError(path.string() + ":" + std::to_string(blank - truth->times_s.begin() + 1) +
                     ": a blank line; expected a time.");
  }
}

// The frames of the truth that were estimated.
Trajectory ReadTruth(const TrajectoryFiles& files, const FrameRange& frames) {
  Trajectory truth = ReadTrajectory(files.truth);
  if (!files.times.empty() && truth.times_s.empty()) {
    AddTimes(files.times, &truth);
  }
  std::vector<SE3d>& poses = truth.T_world_body;
  const int count = static_cast<int>(poses.size());
  if (frames.first >= count || frames.last >= count) {
    throw InputError(files.truth.string() + ": " + std::to_string(count) +
                     " poses; expected --frames within 0:" + std::to_string(count - 1) + ".");
  }
  const int end = frames.last < 0 ? count : frames.last + 1;
  poses = {poses.begin() + frames.first, poses.begin() + end};
  if (!truth.times_s.empty()) {
    truth.times_s = {truth.times_s.begin() + frames.first, truth.times_s.begin() + end};
  }
  return truth;
}

NamedTrajectory Load(const TrajectoryFiles& files, Manifest* manifest) {
  Trajectory estimate = ReadTrajectory(files.estimate);
  const Trajectory truth = ReadTruth(files, TruthFramesFromFlags());
  manifest->AddInput(files.estimate);
  manifest->AddInput(files.truth);
  if (!files.calibration.empty()) {
    const SE3d Tr = ReadKittiCalibration(files.calibration);
    manifest->AddInput(files.calibration);
    for (SE3d& T : estimate.T_world_body) {
      T = Tr * T * Tr.Inverse();
    }
  }
  NamedTrajectory trajectory = {files.name, {}};
  try {
    trajectory.pair = Associate(truth, estimate, MaxTimeDifferenceFromFlags());
  } catch (const InputError& error) {
    throw InputError(files.estimate.string() + " and " + files.truth.string() + ": " +
                     error.what());
  }
  std::cout << trajectory.name << ": " << trajectory.pair.truth.size() << " pairs of poses ("
            << estimate.T_world_body.size() << " estimated, " << truth.T_world_body.size()
            << " true), " << Fixed(PathLengths(trajectory.pair.truth).back(), 1) << " m\n";
  return trajectory;
}

void Evaluate() {
  const std::vector<TrajectoryFiles> all = TrajectoriesFromFlags();
  MaxTimeDifferenceFromFlags();
  TruthFramesFromFlags();
  const int rpe_frames = RpeFramesFromFlags();
  Run run;
  std::vector<NamedTrajectory> trajectories;
  for (const TrajectoryFiles& files : all) {
    trajectories.push_back(Load(files, run.manifest()));
  }
  run.manifest()->AddTiming("read");
  std::cout << std::endl;
  ReportTrajectoryErrors(trajectories, rpe_frames, &run);
  run.manifest()->AddTiming("evaluate");
  const std::string title = trajectories.size() == 1 ? trajectories[0].name : "trajectories";
  DrawTrajectories(trajectories, TitleWithFlags(title), &run);
  run.manifest()->AddTiming("figures");
  run.Finish();
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv,
                          "measures estimated trajectories against the truth: KITTI's t_err and "
                          "r_err over 100 to 800 m, ATE and RPE.",
                          icpscape::Evaluate);
}
