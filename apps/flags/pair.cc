// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/pair.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <utility>

#include "apps/flags/lidar.h"
#include "apps/flags/objective.h"
#include "apps/flags/preparation.h"
#include "apps/flags/sensor.h"
#include "apps/flags/sequence.h"
#include "apps/run/flag.h"
#include "icpscape/cloud/units.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/sequences.h"
#include "icpscape/io/transform.h"

static const icpscape::FlagGroup group(__FILE__, "Input: the pair of scans");

DEFINE_int32(frame, -1,
             "Frame number of the source. In a scene of three scans the last is the default.");
static const icpscape::FlagMark frame_mark(&FLAGS_frame, icpscape::kShown);
DEFINE_int32(target_frame, -1, "Frame number of the target; -1 is the frame before --frame.");
static const icpscape::FlagMark target_frame_mark(&FLAGS_target_frame, icpscape::kShown);
DEFINE_string(source, "",
              "Source cloud, instead of a sequence; docs/inputs.md has the kinds of files.");
static const icpscape::FlagMark source_mark(&FLAGS_source, icpscape::kShown);
DEFINE_string(target, "", "Target cloud, with --source.");
static const icpscape::FlagMark target_mark(&FLAGS_target, icpscape::kShown);
DEFINE_string(
    initial, "identity",
    "Start, the pose at u = 0: identity (paper), previous_motion (the predicted pose), or the "
    "path of a text file of the 4x4 T_target_source.");

namespace icpscape {
namespace {

bool FromFiles() { return !FLAGS_source.empty() || !FLAGS_target.empty(); }

// Frames of the sequence; of a scene, which has three scans, the last two by default.
int SourceFrame() { return FLAGS_frame < 0 ? 2 : FLAGS_frame; }
int TargetFrame() { return FLAGS_target_frame < 0 ? SourceFrame() - 1 : FLAGS_target_frame; }

// For ScanSequence::Pair: reads a scan, prints and records what was read.
PointCloud Read(const std::string& role, const Scan& scan, Manifest* manifest) {
  DroppedPoints dropped;
  PointCloud cloud = scan.read(&dropped);
  std::cout << role << ": " << (scan.file.empty() ? scan.name : scan.file.string()) << ", "
            << cloud.size() << " points";
  if (dropped.non_finite + dropped.zero > 0) {
    std::cout << " (dropped: " << dropped.non_finite << " not finite, " << dropped.zero
              << " at the origin)";
  }
  std::cout << "\n";
  if (!scan.file.empty()) {
    manifest->AddInput(scan.file);
  }
  manifest->SetResult(role + "_points", static_cast<double>(cloud.size()));
  manifest->SetResult(role + "_dropped_non_finite", static_cast<double>(dropped.non_finite));
  manifest->SetResult(role + "_dropped_zero", static_cast<double>(dropped.zero));
  return cloud;
}

// A cloud that lies far out is registered about its middle; see docs/conventions.md.
void PrintOrigin(const std::string& role, const Vec3& origin, Manifest* manifest) {
  if (origin.isZero(0)) {
    return;
  }
  const std::string text =
      Fixed(origin.x(), 0) + " " + Fixed(origin.y(), 0) + " " + Fixed(origin.z(), 0);
  std::cout << role << ": lies far out, and is registered less its origin " << text << " (m)\n";
  manifest->SetResult(role + "_origin", text);
}

// Warns of a cloud whose units look like millimetres, and refuses a pair of two units: no motion
// takes one to the other. Spacings cost a search, so they are asked for where ranges are odd.
void CheckUnits(const ScanPair& pair) {
  const double source_m = RangeOf(pair.source).range_m, target_m = RangeOf(pair.target).range_m;
  constexpr double kOddRangeM = 1000, kOddFactor = 100;
  if (std::max(source_m, target_m) < kOddRangeM &&
      std::max(source_m, target_m) < kOddFactor * std::min(source_m, target_m)) {
    return;
  }
  const CloudScale source = ScaleOf(pair.source), target = ScaleOf(pair.target);
  if (source.IsThousandfold(target) || target.IsThousandfold(source)) {
    const bool larger = source.IsThousandfold(target);
    throw InputError(
        pair.title + ": the source is " +
        Fixed(larger ? source.range_m / target.range_m : target.range_m / source.range_m, 0) +
        (larger ? " times as large as" : " times smaller than") +
        " the target, and its points lie as far apart; expected both in metres.");
  }
  const auto warn = [](const char* role, const CloudScale& scale) {
    if (scale.LooksLikeMillimetres()) {
      std::cerr << "warning: the " << role << " looks like millimetres (half of it beyond "
                << Fixed(scale.range_m, 0) << " m, points " << Fixed(scale.spacing_m, 1)
                << " m apart); expected metres: 0.001 times its coordinates\n";
    }
  };
  warn("source", source);
  warn("target", target);
}

void CheckFrames() {
  if (FLAGS_frame == -1) {
    if (!SceneOfThreeScans()) {
      throw UsageError("no --frame: expected the number of the scan to register.");
    }
    return;
  }
  RequireFlag(FLAGS_frame >= 0, "frame", std::to_string(FLAGS_frame), "the number of a scan");
  if (FLAGS_frame == 0 && FLAGS_target_frame < 0) {
    throw UsageError("--frame=0: no scan comes before it; expected at least 1, or --target_frame.");
  }
}

void PrintVoxels(const char* role, std::size_t before, const PointCloud& after,
                 Manifest* manifest) {
  std::cout << "voxel_filter: leaves " << after.size() << " of the " << role << "'s " << before
            << " points\n";
  manifest->SetResult(std::string("voxel_filter_") + role + "_points",
                      static_cast<double>(after.size()));
}

void PrintMissingNormals(const char* role, const PointCloud& cloud) {
  std::size_t without = 0;
  for (std::size_t i = 0; i < cloud.size() && cloud.has_normals(); ++i) {
    without += cloud.NormalIsValid(i) ? 0 : 1;
  }
  if (without > 0) {
    std::cout << role << ": " << without << " points have no normal\n";
  }
}

}  // namespace

void CheckPairFlags(const std::vector<std::string>& metrics, bool needs_ground_truth) {
  if (FromFiles()) {
    if (SequenceIsGiven()) {
      throw UsageError(
          "--source and --target name two files: expected no --scene, --kitti_root or --scans with "
          "them.");
    }
    RequireFlag(FLAGS_frame < 0 && FLAGS_target_frame < 0, "frame", std::to_string(FLAGS_frame),
                "a sequence with it, and no --source");
    if (FLAGS_source.empty() || FLAGS_target.empty()) {
      throw UsageError("expected --source=FILE and --target=FILE together.");
    }
    SensorFromFlags();
  } else {
    if (!SequenceIsGiven()) {
      throw UsageError(
          "no input: expected --scene=NAME, or --kitti_root=DIR --frame=N, or --scans=DIR "
          "--frame=N, or --source=FILE --target=FILE.");
    }
    CheckSequenceFlags();
    CheckFrames();
    RequireFlag(TargetFrame() != SourceFrame(), "target_frame", std::to_string(FLAGS_target_frame),
                "another scan than --frame");
    RequireFlag(FLAGS_target_frame >= -1, "target_frame", std::to_string(FLAGS_target_frame),
                "the number of a scan, or -1 for the one before --frame");
  }
  if (needs_ground_truth && !FlagsHaveGroundTruth()) {
    throw UsageError(
        "no ground truth: expected --ground_truth=FILE (with --source the 4x4 T_target_source as "
        "text, as icpscape-register writes it).");
  }
  RequireFlag(FLAGS_initial == "identity" || FLAGS_initial == "previous_motion" ||
                  std::filesystem::is_regular_file(FLAGS_initial),
              "initial", FLAGS_initial, "identity, previous_motion or a file");
  SeedFromFlags();
  PreparationFromFlags(metrics);
  ThreadsFromFlags();
}

ScanPair ReadPair(Manifest* manifest) {
  const auto read = [&](const char* role, const Scan& scan) { return Read(role, scan, manifest); };
  ScanPair pair;
  if (FromFiles()) {
    ScanSequence files = OpenTwoScans(FLAGS_source, FLAGS_target);
    PlaceSensors(&files);
    pair = files.Pair(1, 0, read);
    pair.title = files.title;
    if (!GroundTruthFile().empty()) {
      pair.T_ground_truth = pair.origins.FromUser(ReadTransform(GroundTruthFile()));
      manifest->AddInput(GroundTruthFile());
    }
  } else {
    pair = SequenceFromFlags(manifest).Pair(SourceFrame(), TargetFrame(), read);
  }
  if (ReverseFromFlags()) {
    pair.Reverse();
  }
  CheckUnits(pair);
  PrintOrigin("source", pair.origins.source, manifest);
  PrintOrigin("target", pair.origins.target, manifest);
  manifest->AddTiming("read");
  return pair;
}

SE3d InitialPose(const ScanPair& pair, Manifest* manifest) {
  if (FLAGS_initial == "identity") {
    return pair.origins.FromUser(SE3d());
  }
  if (FLAGS_initial == "previous_motion") {
    if (!pair.T_predicted) {
      throw UsageError(
          "--initial=previous_motion: expected true poses, and a scan before each of the two.");
    }
    return *pair.T_predicted;
  }
  manifest->AddInput(FLAGS_initial);
  return pair.origins.FromUser(ReadTransform(FLAGS_initial));
}

PreparedPair PrepareFromFlags(const std::vector<std::string>& metrics, ScanPair* pair,
                              Manifest* manifest) {
  const PreparationOptions options = PreparationFromFlags(metrics);
  unsigned needs = NeedsOf(metrics, ObjectiveSetFromFlags().matching);
  if (pair->T_ground_truth) {
    needs |= kTargetNormal;  // The check of the ground truth is point-to-plane.
  }
  const std::size_t source_points = pair->source.size(), target_points = pair->target.size();
  PreparedPair scans = PreparePair(std::move(pair->source), std::move(pair->target), needs, options,
                                   ThreadsFromFlags());
  if (options.voxel_m > 0) {
    PrintVoxels("source", source_points, scans.source.cloud(), manifest);
    PrintVoxels("target", target_points, scans.target.cloud(), manifest);
  }
  PrintMissingNormals("source", scans.source.cloud());
  PrintMissingNormals("target", scans.target.cloud());
  if (const std::optional<Features>& features = scans.source.features()) {
    std::cout << "source: " << features->num_edge << " edge points, " << features->num_planar
              << " planar points\n";
    manifest->SetResult("edge_points", static_cast<double>(features->num_edge));
    manifest->SetResult("planar_points", static_cast<double>(features->num_planar));
  }
  manifest->AddTiming("prepare");
  return scans;
}

}  // namespace icpscape
