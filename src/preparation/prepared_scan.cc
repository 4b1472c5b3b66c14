// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/preparation/prepared_scan.h"

#include <optional>
#include <utility>

#include "icpscape/cloud/rings.h"
#include "icpscape/filtering/voxel_filter.h"
#include "icpscape/preparation/deskew.h"
#include "icpscape/preparation/elevation.h"
#include "icpscape/residuals/correspondence.h"

namespace icpscape {
namespace {

bool ReadsRings(const FeatureOptions& options) {
  return options.smoothness.neighborhood == SmoothnessNeighborhood::kRing ||
         options.caps.regions_per_ring > 0;
}

}  // namespace

PreparedScan::PreparedScan(SearchableCloud points, std::optional<Features> features)
    : features_(std::move(features)) {
  const PointCloud& cloud = points.cloud();
  if (features_) {
    clouds_.edges.emplace(cloud.Select(features_->edge), points.threads());
    clouds_.planar.emplace(cloud.Select(features_->planar), points.threads());
  }
  clouds_.points = std::move(points);
}

PreparedScan PreparedScan::Select(const std::vector<char>& keep, int threads) const {
  return PreparedScan(SearchableCloud(cloud().Select(keep), threads),
                      features_ ? std::optional(features_->Select(keep)) : std::nullopt);
}

PreparedScan Prepare(PointCloud scan, unsigned needs, const PreparationOptions& options,
                     int threads, const Vec6& velocity) {
  const bool reads_rings =
      (needs & (kTargetLine | kTargetPatch)) != 0 && ReadsRings(options.features);
  CorrectElevation(options.elevation_correction_deg, &scan);
  if (!velocity.isZero(0)) {
    if (reads_rings) {
      RecoverRings(&scan);  // From the azimuths that the lidar measured.
    }
    Deskew(velocity, threads, &scan);
  }
  if (options.voxel_m > 0) {
    scan = VoxelFilter(scan, options.voxel_m);
  }
  std::optional<NeighborSearch> search;
  if ((needs & (kSourceNormal | kTargetNormal)) != 0) {
    search.emplace(scan.View(), threads);
    EstimateNormals(*search, options.normals, threads, &scan);
  }
  std::optional<Features> features;
  if ((needs & (kTargetLine | kTargetPatch)) != 0) {
    if (reads_rings) {
      RecoverRings(&scan);
    }
    features = ExtractFeatures(scan, options.features, threads);
  }
  SearchableCloud points = search ? SearchableCloud(std::move(scan), *std::move(search))
                                  : SearchableCloud(std::move(scan), threads);
  return PreparedScan(std::move(points), std::move(features));
}

}  // namespace icpscape
