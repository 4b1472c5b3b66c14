// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <iostream>
#include <memory>

#include "apps/flags/lidar.h"
#include "apps/flags/simulation.h"
#include "apps/run/app.h"
#include "apps/run/progress.h"
#include "apps/run/run.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/error.h"
#include "icpscape/io/dataset.h"
#include "icpscape/io/sha256.h"
#include "icpscape/io/transform.h"
#include "icpscape/simulation/drive.h"
#include "icpscape/simulation/random.h"
#include "icpscape/simulation/route.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulator.h"

namespace icpscape {
namespace {

// All that a scan depends on besides its index. The program itself belongs to it: while it is being
// developed, its version does not tell one build from another.
std::string Parameters(const std::string& what) {
  return Version() + "; program " + Sha256("/proc/self/exe") + "; " + what + "; " + LidarText();
}

// `make_world` is called when a scan is needed: not for a full cache.
void Write(const std::string& name, const std::string& what, const std::vector<SE3d>& T_world_lidar,
           const std::function<World()>& make_world, double first_time_s, Run* run) {
  DatasetOptions options;
  options.root = run->folder();
  options.name = name;
  options.ply = SimulationFromFlags().ply;
  options.point_times = LidarFromFlags().skewed;
  options.parameters = Parameters(what);
  run->Lasting("sequences/" + name);
  run->Lasting("poses/" + name + ".txt");
  const std::vector<LidarMotion> motions = MotionsThrough(T_world_lidar);
  std::unique_ptr<Simulator> simulator;
  const auto scan = [&](int i) {
    if (!simulator) {
      simulator = std::make_unique<Simulator>(make_world(), LidarFromFlags(), SeedFromFlags());
    }
    return simulator->Scan(motions[static_cast<std::size_t>(i)], first_time_s + i * kScanPeriodS, i,
                           ThreadsFromFlags());
  };
  DatasetSummary summary;
  {
    Progress progress("scans", static_cast<int>(T_world_lidar.size()));
    summary = WriteDataset(options, T_world_lidar, scan, [&](int done) { progress.Show(done); });
  }
  std::cout << name << ": " << summary.simulated << " scans simulated, " << summary.kept
            << " kept\n";
  run->manifest()->SetResult("simulated_" + name, summary.simulated);
  run->manifest()->SetResult("kept_" + name, summary.kept);
  run->manifest()->AddTiming(name);
}

void WriteScene(const std::string& name, Run* run) {
  Scene scene = MakeScene(name, SeedFromFlags());
  const std::vector<SE3d> poses(scene.T_world_lidar.begin(), scene.T_world_lidar.end());
  Write(
      name, "scene " + name, poses, [&] { return std::move(scene.world); }, -kScanPeriodS, run);
}

void WriteDrive(const SimulationPlan& plan, Run* run) {
  const std::vector<SE3d> poses = PosesOfDrive(plan);
  const FrameRange& frames = plan.frames;
  const int count = static_cast<int>(poses.size());
  if (frames.first >= count || frames.last >= count) {
    throw UsageError("--frames: drive " + plan.drive +
                     " has frames 0:" + std::to_string(count - 1) + "; expected a range within.");
  }
  // The whole route makes the town: part of a drive is the same as within the whole.
  const std::vector<SE3d> all = ProjectToGround(poses);
  const auto first = all.begin() + frames.first;
  const auto last = frames.last < 0 ? all.end() : all.begin() + frames.last + 1;
  std::string route;
  for (const SE3d& T : all) {
    route += FormatTransform(T);
  }
  const std::string what = "drive " + plan.drive + " from frame " + std::to_string(frames.first) +
                           " on a route of hash " + std::to_string(std::hash<std::string>()(route));
  Write(
      plan.drive, what, {first, last},
      [&] { return MakeDrive(poses, MixKeys(SeedFromFlags(), 1)).world; }, 0, run);
}

void Simulate() {
  const SimulationPlan plan = SimulationFromFlags();
  LidarFromFlags();
  SeedFromFlags();
  ThreadsFromFlags();
  Run run;
  if (plan.scenes.empty()) {
    WriteDrive(plan, &run);
  }
  for (const std::string& name : plan.scenes) {
    WriteScene(name, &run);
  }
  run.Finish();
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv,
                          "simulates the lidar scans of a scene, or of a drive through a town, and "
                          "writes them in KITTI's layout with labels, rings and true poses.",
                          icpscape::Simulate);
}
