// SPDX-License-Identifier: BSD-3-Clause
#include "apps/filter_flags.h"

#include <gflags/gflags.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "apps/app.h"
#include "src/common/error.h"
#include "src/common/text.h"
#include "src/filtering/ego_blind_spot.h"
#include "src/filtering/filter_statistics.h"
#include "src/filtering/octree_correspondence_filter.h"
#include "src/io/transform.h"

DEFINE_double(artificial_blind_spot_m, 0,
              "If positive: remove the points within this horizontal radius of the sensor (m); 5 "
              "in the paper, sec. 4.2.");
DEFINE_double(ego_filter_m, 0,
              "If positive: ego blind spot (ego overlap) filter with this radius (m); 5 in the "
              "paper's text, 6 in its data's file name.");
DEFINE_double(octree_voxel_m, 0,
              "If positive: Octree Correspondence Filter with voxels of this size (m); 0.1 in the "
              "paper.");
DEFINE_string(filter_estimate, "previous_motion",
              "T_e of the filters: previous_motion (paper), identity, ground_truth, or the path of "
              "a text file of the 4x4 T_target_source.");

namespace icpscape {
namespace {

void Apply(const char* name, const FilteredPair& filtered, ScanPair* pair, Manifest* manifest) {
  const double source = CountKept(filtered.keep_source).Fraction();
  const double target = CountKept(filtered.keep_target).Fraction();
  std::printf("%s: keeps %.1f %% of the source, %.1f %% of the target\n", name, 100 * source,
              100 * target);
  manifest->SetResult(std::string(name) + "_kept_source", source);
  manifest->SetResult(std::string(name) + "_kept_target", target);
  if (filtered.source.empty() || filtered.target.empty()) {
    throw ComputationError(std::string(name) + ": no point is left; expected some to agree.");
  }
  pair->KeepSource(filtered.keep_source);
  pair->target = filtered.target;
}

SE3d Estimate(const ScanPair& pair, Manifest* manifest) {
  if (FLAGS_filter_estimate == "identity") {
    return SE3d();
  }
  if (FLAGS_filter_estimate == "ground_truth") {
    if (!pair.T_ground_truth) {
      throw UsageError("--filter_estimate=ground_truth: expected an input with a ground truth.");
    }
    return *pair.T_ground_truth;
  }
  if (FLAGS_filter_estimate == "previous_motion") {
    if (!pair.T_prior) {
      throw UsageError(
          "--filter_estimate=previous_motion: expected an input that knows the motion before.");
    }
    return *pair.T_prior;
  }
  manifest->AddInput(FLAGS_filter_estimate);
  return ReadTransform(FLAGS_filter_estimate);
}

}  // namespace

void CheckFilterFlags() {
  for (const auto& [flag, value] :
       {std::pair("artificial_blind_spot_m", FLAGS_artificial_blind_spot_m),
        std::pair("ego_filter_m", FLAGS_ego_filter_m),
        std::pair("octree_voxel_m", FLAGS_octree_voxel_m)}) {
    RequireFlag(value >= 0 && std::isfinite(value), flag, Number(value), "a length in m, or 0");
  }
  RequireFlag(FLAGS_filter_estimate == "previous_motion" || FLAGS_filter_estimate == "identity" ||
                  FLAGS_filter_estimate == "ground_truth" ||
                  std::filesystem::is_regular_file(FLAGS_filter_estimate),
              "filter_estimate", FLAGS_filter_estimate,
              "previous_motion, identity, ground_truth or a file");
}

void FilterPair(ScanPair* pair, Manifest* manifest) {
  if (FLAGS_artificial_blind_spot_m > 0) {
    Apply("artificial_blind_spot",
          ArtificialBlindSpots(pair->source, pair->target, FLAGS_artificial_blind_spot_m), pair,
          manifest);
  }
  if (FLAGS_ego_filter_m > 0) {
    Apply("ego_filter",
          EgoBlindSpotFilter(pair->source, pair->target, Estimate(*pair, manifest),
                             FLAGS_ego_filter_m),
          pair, manifest);
  }
  if (FLAGS_octree_voxel_m > 0) {
    Apply("octree_filter",
          OctreeCorrespondenceFilter(pair->source, pair->target, Estimate(*pair, manifest),
                                     {FLAGS_octree_voxel_m}),
          pair, manifest);
  }
}

}  // namespace icpscape
