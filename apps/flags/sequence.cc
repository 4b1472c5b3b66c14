// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/sequence.h"

#include <gflags/gflags.h>

#include "apps/flags/lidar.h"
#include "apps/flags/sensor.h"
#include "apps/run/flag.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/error.h"
#include "icpscape/io/sequences.h"
#include "icpscape/io/trajectory.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulated_sequence.h"

static const icpscape::FlagGroup group(__FILE__, "Input: scans");

DEFINE_string(scene, "",
              "Simulated scans of --seed: straight_street, right_turn, highway or "
              "highway_overtaking (three scans), or town (a drive of 228 m).");
static const icpscape::FlagMark scene_mark(&FLAGS_scene, icpscape::kShown);
DEFINE_string(kitti_root, "", "Or: folder of the KITTI odometry data (sequences/ and poses/).");
static const icpscape::FlagMark kitti_root_mark(&FLAGS_kitti_root, icpscape::kAside);
DEFINE_string(sequence, "00", "KITTI sequence, with --kitti_root.");
static const icpscape::FlagMark sequence_mark(&FLAGS_sequence, icpscape::kShown);
DEFINE_string(
    scans, "",
    "Or: a folder of .bin, .pcd, .ply or .npy scans, or a raw drive of KITTI's (a folder with "
    "velodyne_points/).");
static const icpscape::FlagMark scans_mark(&FLAGS_scans, icpscape::kAside);
DEFINE_string(ground_truth, "",
              "Ground truth of your own scans. With --scans: the trajectory of the lidar, in "
              "KITTI's or TUM's format, with a pose for each scan. With two files: the 4x4 "
              "T_target_source as text.");
static const icpscape::FlagMark ground_truth_mark(&FLAGS_ground_truth, icpscape::kAside);
DEFINE_bool(reverse, false, "Swaps source and target; of a drive, the last scan comes first.");

static const icpscape::FlagMark reverse_mark(&FLAGS_reverse,
                                             icpscape::kShown | icpscape::kNotOfDraws);

namespace icpscape {

bool SceneIsGiven() { return !FLAGS_scene.empty(); }
bool SceneOfThreeScans() { return SceneIsGiven() && FLAGS_scene != kTown; }

bool SequenceIsGiven() {
  return SceneIsGiven() || !FLAGS_kitti_root.empty() || !FLAGS_scans.empty();
}

void CheckSequenceFlags() {
  const int given = (FLAGS_scene.empty() ? 0 : 1) + (FLAGS_kitti_root.empty() ? 0 : 1) +
                    (FLAGS_scans.empty() ? 0 : 1);
  if (given != 1) {
    throw UsageError("expected one of --scene=NAME, --kitti_root=DIR and --scans=DIR.");
  }
  RequireFlag(FLAGS_ground_truth.empty() || !FLAGS_scans.empty(), "ground_truth",
              FLAGS_ground_truth, "--scans with it: scenes and KITTI's sequences have their poses");
  if (SceneIsGiven()) {
    RequireFlag(!SensorFromFlags(), "scene", FLAGS_scene,
                "no --sensor_origin with it: a simulated sensor is at 0,0,0");
    if (FLAGS_scene != kTown) {
      CheckSceneName(FLAGS_scene);
    }
    LidarFromFlags();
    SeedFromFlags();
  }
  SensorFromFlags();
}

ScanSequence SequenceFromFlags(Manifest* manifest) {
  if (SceneIsGiven()) {
    return SimulatedSequence(FLAGS_scene, SeedFromFlags(), LidarFromFlags(), ThreadsFromFlags());
  }
  ScanSequence sequence = FLAGS_scans.empty() ? OpenKittiSequence(FLAGS_kitti_root, FLAGS_sequence)
                                              : OpenScanFolder(FLAGS_scans);
  if (!FLAGS_scans.empty() && !FLAGS_ground_truth.empty()) {
    sequence.T_world_lidar = ReadTrajectory(FLAGS_ground_truth).T_world_body;
    sequence.poses_file = FLAGS_ground_truth;
    sequence.inputs.push_back(FLAGS_ground_truth);
    if (sequence.T_world_lidar.size() != sequence.scans.size()) {
      throw InputError(FLAGS_ground_truth + ": " + std::to_string(sequence.T_world_lidar.size()) +
                       " poses; expected one for each of the " +
                       std::to_string(sequence.scans.size()) + " scans in " + FLAGS_scans + ".");
    }
  }
  for (const std::filesystem::path& input : sequence.inputs) {
    manifest->AddInput(input);
  }
  PlaceSensors(&sequence);
  return sequence;
}

bool FlagsHaveGroundTruth() {
  return SceneIsGiven() || !FLAGS_kitti_root.empty() || !FLAGS_ground_truth.empty();
}

const std::string& GroundTruthFile() { return FLAGS_ground_truth; }

bool ReverseFromFlags() { return FLAGS_reverse; }

}  // namespace icpscape
