// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <iostream>

#include "apps/flags/lidar.h"
#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/common/parallel.h"
#include "src/common/text.h"
#include "src/io/kitti.h"
#include "src/io/manifest.h"
#include "src/io/sequences.h"
#include "src/io/sha256.h"
#include "src/io/transform.h"
#include "src/simulation/dataset.h"
#include "src/simulation/drive.h"
#include "src/simulation/random.h"
#include "src/simulation/route.h"
#include "src/simulation/scenes.h"
#include "src/simulation/simulated_sequence.h"
#include "src/simulation/simulator.h"

DEFINE_string(scene, "",
              "Scene to scan three times, with the paper's motion: straight_street, right_turn, "
              "highway, highway_overtaking, or all; scan 2 is the source, scan 1 the target. Or "
              "town: a drive of 228 m.");
DEFINE_string(kitti_root, "", "Or: folder of the KITTI poses and calibration, for a long drive.");
DEFINE_string(sequence, "07", "KITTI sequence to drive along, with --kitti_root.");
DEFINE_string(frames, "",
              "First and last frame of the drive, as in 0:99; none is the whole sequence.");
DEFINE_bool(ply, false, "Write each scan as .ply as well.");
DEFINE_int32(threads, 0, "Threads; 0 is all of the machine. Results do not depend on it.");
DEFINE_string(out, "out/simulated", "Folder for the data, in KITTI's layout.");

DECLARE_int32(seed);

namespace icpscape {
namespace {

// All that a scan depends on besides its index. The program itself belongs to it: while it is being
// developed, its version does not tell one build from another.
std::string Parameters(const std::string& what) {
  const LidarOptions lidar = LidarFromFlags();
  return Version() + "; program " + Sha256("/proc/self/exe") + "; " + what + "; seed " +
         std::to_string(FLAGS_seed) + "; azimuth_step_deg " + Number(lidar.azimuth_step_deg) +
         "; range_noise_m " + Number(lidar.range_noise_m) + "; ring_bias_m " +
         Number(lidar.ring_bias_m) + "; dropout " + Number(lidar.dropout);
}

int Threads() { return FLAGS_threads > 0 ? FLAGS_threads : HardwareThreads(); }

// `make` builds world and poses, and is called when a scan is needed: not for a full cache.
void Write(const std::string& name, const std::string& parameters,
           const std::vector<SE3d>& T_world_lidar, const std::function<World()>& make_world,
           double first_time_s) {
  DatasetOptions options;
  options.root = FLAGS_out;
  options.name = name;
  options.ply = FLAGS_ply;
  options.parameters = parameters;
  std::unique_ptr<Simulator> simulator;
  const auto scan = [&](int i) {
    if (!simulator) {
      simulator = std::make_unique<Simulator>(make_world(), LidarFromFlags(), SeedFromFlags());
    }
    return simulator->Scan(T_world_lidar[static_cast<std::size_t>(i)],
                           first_time_s + i * kScanPeriodS, i, Threads());
  };
  DatasetSummary summary;
  {
    Progress progress("scans", static_cast<int>(T_world_lidar.size()));
    summary = WriteDataset(options, T_world_lidar, scan, [&](int done) { progress.Show(done); });
  }
  std::cout << (options.root / "sequences" / name).string() << ": " << summary.simulated
            << " scans simulated, " << summary.kept << " kept\n";
}

void WriteScene(const std::string& name) {
  Scene scene = MakeScene(name, SeedFromFlags());
  const std::vector<SE3d> poses(scene.T_world_lidar.begin(), scene.T_world_lidar.end());
  Write(
      name, Parameters("scene " + name), poses, [&] { return std::move(scene.world); },
      -kScanPeriodS);
}

void WriteDrive(const std::string& name, const std::vector<SE3d>& poses, const FrameRange& frames) {
  const int count = static_cast<int>(poses.size());
  if (frames.first >= count || frames.last >= count) {
    throw UsageError("--frames=" + FLAGS_frames + ": drive " + name +
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
  Write(
      name,
      Parameters("drive " + name + " from frame " + std::to_string(frames.first) +
                 " on a route of hash " + std::to_string(std::hash<std::string>()(route))),
      {first, last}, [&] { return MakeDrive(poses, MixKeys(SeedFromFlags(), 1)).world; }, 0);
}

std::vector<SE3d> LidarPoses() {
  const ScanSequence sequence = OpenKittiSequence(FLAGS_kitti_root, FLAGS_sequence);
  if (sequence.T_world_lidar.empty()) {
    throw InputError(KittiFiles(FLAGS_kitti_root, FLAGS_sequence).Poses().string() +
                     ": no poses; expected them, and calib.txt, to drive along.");
  }
  return sequence.T_world_lidar;
}

void Simulate() {
  const bool drive = !FLAGS_kitti_root.empty();
  if (drive == !FLAGS_scene.empty()) {
    throw UsageError("expected --scene=NAME, or --kitti_root=DIR --sequence=SS, and not both.");
  }
  if (FLAGS_threads < 0 || FLAGS_threads > 1024) {
    throw UsageError("--threads=" + std::to_string(FLAGS_threads) + ": expected 0 (all) to 1024.");
  }
  const FrameRange frames = FrameRangeFromText(FLAGS_frames);
  LidarFromFlags();
  SeedFromFlags();
  if (drive) {
    WriteDrive(FLAGS_sequence, LidarPoses(),
               frames);
    return;
  }
  if (FLAGS_scene == kTown) {
    WriteDrive(kTown, TownRoute(), frames);
    return;
  }
  if (!FLAGS_frames.empty()) {
    throw UsageError(
        "--frames belongs to a drive: expected --kitti_root, or --scene=town, with it.");
  }
  const std::vector<std::string> names =
      FLAGS_scene == "all" ? SceneNames() : std::vector<std::string>{FLAGS_scene};
  for (const std::string& name : names) {
    CheckSceneName(name);
  }
  for (const std::string& name : names) {
    WriteScene(name);
  }
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv,
                          "simulates the lidar scans of a scene, or of a drive through a town, and "
                          "writes them in KITTI's layout with labels, rings and true poses.",
                          icpscape::Simulate);
}
