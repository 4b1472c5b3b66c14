// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/pair.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <utility>

#include "apps/flags/lidar.h"
#include "apps/flags/objective.h"
#include "apps/flags/preprocessing.h"
#include "apps/run/app.h"
#include "residuals/correspondence.h"
#include "src/cloud/normals.h"
#include "src/cloud/rings.h"
#include "src/common/error.h"
#include "src/common/parallel.h"
#include "src/common/text.h"
#include "src/filtering/voxel_filter.h"
#include "src/io/kitti.h"
#include "src/io/output.h"
#include "src/io/point_files.h"
#include "src/io/transform.h"
#include "src/simulation/scenes.h"

static const icpscape::FlagGroup group(__FILE__, "Input: a pair of scans");

DECLARE_int32(seed);
DEFINE_string(scene, "",
              "Simulated scene: straight_street, right_turn, highway or highway_overtaking, by "
              "--seed; needs no data.");
static const icpscape::FlagMark scene_mark(&FLAGS_scene, icpscape::kShown);
DEFINE_string(kitti_root, "", "Folder of the KITTI odometry data (with sequences/ and poses/).");
static const icpscape::FlagMark kitti_root_mark(&FLAGS_kitti_root, icpscape::kAside);
DEFINE_string(sequence, "00", "KITTI sequence.");
static const icpscape::FlagMark sequence_mark(&FLAGS_sequence, icpscape::kShown);
DEFINE_int32(frame, -1, "KITTI scan to register: the source.");
static const icpscape::FlagMark frame_mark(&FLAGS_frame, icpscape::kShown);
DEFINE_int32(target_frame, -1, "KITTI scan to register to; -1 is the one before --frame.");
static const icpscape::FlagMark target_frame_mark(&FLAGS_target_frame, icpscape::kShown);
DEFINE_string(source, "", "Source cloud (.bin, .pcd or .ply), instead of --kitti_root.");
static const icpscape::FlagMark source_mark(&FLAGS_source, icpscape::kShown);
DEFINE_string(target, "", "Target cloud, with --source.");
static const icpscape::FlagMark target_mark(&FLAGS_target, icpscape::kShown);
DEFINE_string(ground_truth, "", "Text file of the true 4x4 T_target_source, with --source.");
static const icpscape::FlagMark ground_truth_mark(&FLAGS_ground_truth, icpscape::kShown);
DEFINE_bool(reverse, false, "Swap source and target, and invert what is known about their motion.");
static const icpscape::FlagMark reverse_mark(&FLAGS_reverse,
                                             icpscape::kShown | icpscape::kNotOfDraws);
DEFINE_string(
    initial, "identity",
    "Pose at u = 0 and start of register: identity (paper), previous_motion, or the path of a "
    "text file of the 4x4 T_target_source.");

namespace icpscape {
namespace {

bool FromScene() { return !FLAGS_scene.empty(); }
bool FromKitti() { return !FLAGS_kitti_root.empty(); }

int TargetFrame() { return FLAGS_target_frame >= 0 ? FLAGS_target_frame : FLAGS_frame - 1; }

PointCloud Load(const std::string& role, const std::filesystem::path& path, Manifest* manifest) {
  DroppedPoints dropped;
  PointCloud cloud = ReadPointFile(path, &dropped);
  std::cout << role << ": " << path.string() << ", " << cloud.size() << " points";
  if (dropped.non_finite + dropped.zero > 0) {
    std::cout << " (dropped: " << dropped.non_finite << " not finite, " << dropped.zero
              << " at the origin)";
  }
  std::cout << "\n";
  manifest->AddInput(path);
  manifest->SetResult(role + "_points", static_cast<double>(cloud.size()));
  manifest->SetResult(role + "_dropped_non_finite", static_cast<double>(dropped.non_finite));
  manifest->SetResult(role + "_dropped_zero", static_cast<double>(dropped.zero));
  return cloud;
}

void SimulateScene(ScanPair* pair, Manifest* manifest) {
  SimulatedPair simulated =
      SimulatePair(FLAGS_scene, SeedFromFlags(), LidarFromFlags(), ThreadsFromFlags());
  pair->title = "simulated " + FLAGS_scene + ", seed " + std::to_string(FLAGS_seed) +
                ", motion of KITTI " + simulated.paper_frame;
  pair->T_ground_truth = simulated.T_target_source;
  pair->truth_is_exact = true;
  pair->T_prior = simulated.T_prior;
  pair->source = std::move(simulated.source);
  pair->target = std::move(simulated.target);
  std::cout << pair->title << ": source " << pair->source.size() << " points, target "
            << pair->target.size() << " points\n";
  manifest->SetResult("source_points", static_cast<double>(pair->source.size()));
  manifest->SetResult("target_points", static_cast<double>(pair->target.size()));
}

void LoadKitti(ScanPair* pair, Manifest* manifest) {
  const KittiSequence sequence(FLAGS_kitti_root, FLAGS_sequence);
  pair->title = "KITTI " + FLAGS_sequence + ", scan " + std::to_string(FLAGS_frame) + " to " +
                std::to_string(TargetFrame());
  pair->T_ground_truth = sequence.RelativeMotion(TargetFrame(), FLAGS_frame);
  if (TargetFrame() > 0 && FLAGS_frame > 0) {
    pair->T_prior = sequence.RelativeMotion(TargetFrame() - 1, FLAGS_frame - 1);
  }
  manifest->AddInput(sequence.PosesPath());
  manifest->AddInput(sequence.CalibrationPath());
  pair->source = Load("source", sequence.ScanPath(FLAGS_frame), manifest);
  pair->target = Load("target", sequence.ScanPath(TargetFrame()), manifest);
}

void LoadFiles(ScanPair* pair, Manifest* manifest) {
  pair->title = std::filesystem::path(FLAGS_source).filename().string() + " to " +
                std::filesystem::path(FLAGS_target).filename().string();
  if (!FLAGS_ground_truth.empty()) {
    pair->T_ground_truth = ReadTransform(FLAGS_ground_truth);
    manifest->AddInput(FLAGS_ground_truth);
  }
  pair->source = Load("source", FLAGS_source, manifest);
  pair->target = Load("target", FLAGS_target, manifest);
}

void Reverse(ScanPair* pair) {
  std::swap(pair->source, pair->target);
  for (std::optional<SE3d>* T : {&pair->T_ground_truth, &pair->T_prior}) {
    if (*T) {
      *T = (*T)->Inverse();
    }
  }
  pair->title += ", reversed";
}

SE3d InitialPose(const ScanPair& pair, Manifest* manifest) {
  if (FLAGS_initial == "identity") {
    return SE3d();
  }
  if (FLAGS_initial == "previous_motion") {
    if (!pair.T_prior) {
      throw UsageError(
          "--initial=previous_motion: expected an input that knows the motion before.");
    }
    return *pair.T_prior;
  }
  manifest->AddInput(FLAGS_initial);
  return ReadTransform(FLAGS_initial);
}

void ThinByVoxels(double voxel_m, ScanPair* pair, Manifest* manifest) {
  for (const auto& [role, cloud] :
       {std::pair("source", &pair->source), std::pair("target", &pair->target)}) {
    const std::size_t before = cloud->size();
    *cloud = VoxelFilter(*cloud, voxel_m);
    std::cout << "voxel_filter: leaves " << cloud->size() << " of the " << role << "'s " << before
              << " points\n";
    manifest->SetResult(std::string("voxel_filter_") + role + "_points",
                        static_cast<double>(cloud->size()));
  }
  manifest->AddTiming("voxel_filter");
}

// Before any filter: a scan line with holes has other neighbours.
void AddFeatures(const FeatureOptions& options, ScanPair* pair, Manifest* manifest) {
  if (options.smoothness.neighborhood == SmoothnessNeighborhood::kRing ||
      options.caps.regions_per_ring > 0) {
    RecoverRings(&pair->source);
  }
  pair->features = ExtractFeatures(pair->source, options, ThreadsFromFlags());
  std::cout << "source: " << pair->features.num_edge << " edge points, "
            << pair->features.num_planar << " planar points\n";
  manifest->SetResult("edge_points", static_cast<double>(pair->features.num_edge));
  manifest->SetResult("planar_points", static_cast<double>(pair->features.num_planar));
}

void AddNormals(const std::string& role, const NeighborhoodOptions& options, PointCloud* cloud) {
  const std::size_t without = EstimateNormals(options, ThreadsFromFlags(), cloud);
  if (without > 0) {
    std::cout << role << ": " << without << " points have no normal\n";
  }
}

}  // namespace

void CheckPairFlags(const std::vector<std::string>& metrics, bool needs_ground_truth) {
  if (FromScene()) {
    if (FromKitti() || !FLAGS_source.empty() || !FLAGS_target.empty() ||
        !FLAGS_ground_truth.empty()) {
      throw UsageError(
          "--scene names an input of its own: expected neither --kitti_root nor --source, --target "
          "and --ground_truth with it.");
    }
    CheckSceneName(FLAGS_scene);
    LidarFromFlags();
  } else if (FromKitti()) {
    if (!FLAGS_source.empty() || !FLAGS_target.empty() || !FLAGS_ground_truth.empty()) {
      throw UsageError(
          "--kitti_root and --source name two inputs; expected one of them (with --kitti_root the "
          "ground truth comes from the poses).");
    }
    if (FLAGS_frame == -1) {
      throw UsageError("no --frame: expected the number of a scan with --kitti_root.");
    }
    RequireFlag(FLAGS_frame >= 0, "frame", std::to_string(FLAGS_frame), "the number of a scan");
    if (FLAGS_frame == 0 && FLAGS_target_frame < 0) {
      throw UsageError(
          "--frame=0: no scan comes before it; expected at least 1, or --target_frame.");
    }
    RequireFlag(FLAGS_target_frame != FLAGS_frame, "target_frame",
                std::to_string(FLAGS_target_frame), "another scan than --frame");
    RequireFlag(FLAGS_target_frame >= -1, "target_frame", std::to_string(FLAGS_target_frame),
                "the number of a scan, or -1 for the one before --frame");
  } else if (FLAGS_source.empty() || FLAGS_target.empty()) {
    throw UsageError(
        "no input: expected --scene=NAME, or --kitti_root=DIR --frame=N, or --source=FILE "
        "--target=FILE.");
  }
  if (needs_ground_truth && !FromScene() && !FromKitti() && FLAGS_ground_truth.empty()) {
    throw UsageError(
        "no ground truth: expected --ground_truth=FILE (4x4 T_target_source as text; "
        "icpscape-register writes one that can stand in).");
  }
  RequireFlag(FLAGS_initial == "identity" || FLAGS_initial == "previous_motion" ||
                  std::filesystem::is_regular_file(FLAGS_initial),
              "initial", FLAGS_initial, "identity, previous_motion or a file");
  SeedFromFlags();
  PreprocessingFromFlags(metrics);
  ThreadsFromFlags();
}

ScanPair LoadPair(const std::vector<std::string>& metrics, Manifest* manifest) {
  ScanPair pair;
  if (FromScene()) {
    SimulateScene(&pair, manifest);
  } else if (FromKitti()) {
    LoadKitti(&pair, manifest);
  } else {
    LoadFiles(&pair, manifest);
  }
  if (FLAGS_reverse) {
    Reverse(&pair);
  }
  pair.T_initial = InitialPose(pair, manifest);
  const PreprocessingOptions options = PreprocessingFromFlags(metrics);
  CorrectElevation(options.elevation_correction_deg, &pair.source);
  CorrectElevation(options.elevation_correction_deg, &pair.target);
  manifest->AddTiming("read");
  if (options.voxel_m > 0) {
    ThinByVoxels(options.voxel_m, &pair, manifest);
  }
  // The ground-truth check is point-to-plane.
  unsigned needs = pair.T_ground_truth ? static_cast<unsigned>(kTargetNormal) : 0U;
  if (ObjectiveSetFromFlags().matching.max_normal_angle_rad > 0) {
    needs |= kSourceNormal | kTargetNormal;
  }
  bool features = false;
  for (const std::string& metric : metrics) {
    needs |= MetricFunctionsOf(metric).needs;
    features |= NeedsFeatures(metric);
  }
  if ((needs & kSourceNormal) != 0) {
    AddNormals("source", options.normals, &pair.source);
  }
  if ((needs & kTargetNormal) != 0) {
    AddNormals("target", options.normals, &pair.target);
  }
  if (features) {
    AddFeatures(options.features, &pair, manifest);
  }
  manifest->AddTiming("normals_and_features");
  return pair;
}

std::optional<GroundTruthCheck> GroundTruthCheckOf(const ScanPair& pair, bool needed,
                                                   Manifest* manifest) {
  if (pair.truth_is_exact) {
    std::cout << "ground truth: exact, since simulated\n";
    GroundTruthCheck check;
    check.T_refined = *pair.T_ground_truth;
    return check;
  }
  try {
    GroundTruthCheck check =
        CheckGroundTruth(pair.source, pair.target, *pair.T_ground_truth, ThreadsFromFlags());
    const double degrees = check.rotation_rad * 180 / M_PI;
    std::printf("ground-truth check: point-to-plane settles %.4f m, %.4f deg from it\n",
                check.translation_m, degrees);
    manifest->SetResult("ground_truth_check_m", check.translation_m);
    manifest->SetResult("ground_truth_check_deg", degrees);
    manifest->AddTiming("ground_truth_check");
    return check;
  } catch (const ComputationError& error) {
    if (needed) {
      throw;
    }
    std::cout << "ground-truth check: without an answer (" << error.what() << ")\n";
    return std::nullopt;
  }
}

}  // namespace icpscape
