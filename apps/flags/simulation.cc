// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/simulation.h"

#include <gflags/gflags.h>

#include "apps/run/flag.h"
#include "icpscape/common/error.h"
#include "icpscape/io/kitti.h"
#include "icpscape/simulation/route.h"
#include "icpscape/simulation/scenes.h"

static const icpscape::FlagGroup group(__FILE__, "Scene or drive");

DEFINE_string(scene, "",
              "Scene of three scans, with the motion of the paper's frames: straight_street, "
              "right_turn, highway, highway_overtaking, or all. Scan 2 is the source, scan 1 the "
              "target. Or town: a drive of 228 m.");
DEFINE_string(kitti_root, "", "Or: folder of the KITTI poses and calibration, for a long drive.");
static const icpscape::FlagMark kitti_root_mark(&FLAGS_kitti_root, icpscape::kAside);
DEFINE_string(sequence, "07", "KITTI sequence to drive along, with --kitti_root.");
DEFINE_string(frames, "",
              "First and last frame of the drive, as in 0:99. Without it: the whole sequence.");
DEFINE_bool(ply, false, "Writes each scan as .ply as well.");
static const icpscape::FlagMark ply_mark(&FLAGS_ply, icpscape::kAside);

namespace icpscape {

SimulationPlan SimulationFromFlags() {
  const bool from_kitti = !FLAGS_kitti_root.empty();
  if (from_kitti == !FLAGS_scene.empty()) {
    throw UsageError("expected --scene=NAME, or --kitti_root=DIR --sequence=SS, and not both.");
  }
  SimulationPlan plan;
  plan.frames = FrameRangeFromText(FLAGS_frames);
  plan.ply = FLAGS_ply;
  if (from_kitti) {
    plan.drive = FLAGS_sequence;
    plan.kitti_root = FLAGS_kitti_root;
  } else if (FLAGS_scene == "town") {
    plan.drive = FLAGS_scene;
  } else {
    RequireFlag(FLAGS_frames.empty(), "frames", FLAGS_frames,
                "--kitti_root, or --scene=town, with it");
    plan.scenes = {FLAGS_scene};
    if (FLAGS_scene == "all") {
      plan.scenes = SceneNames();
    }
    for (const std::string& name : plan.scenes) {
      CheckSceneName(name);
    }
  }
  return plan;
}

std::vector<SE3d> PosesOfDrive(const SimulationPlan& plan) {
  if (plan.kitti_root.empty()) {
    return TownRoute();
  }
  const ScanSequence sequence = OpenKittiSequence(plan.kitti_root, plan.drive);
  if (sequence.T_world_lidar.empty()) {
    throw InputError(KittiFiles(plan.kitti_root, plan.drive).Poses().string() +
                     ": no poses; expected them, and calib.txt, to drive along.");
  }
  return sequence.T_world_lidar;
}

}  // namespace icpscape
