// SPDX-License-Identifier: BSD-3-Clause
#include "src/odometry/preprocessing.h"

#include <utility>

#include "src/cloud/rings.h"
#include "src/filtering/voxel_filter.h"
#include "src/io/kitti.h"

namespace icpscape {

std::unique_ptr<const PreparedScan> Prepare(PointCloud scan, unsigned needs,
                                            const PreprocessingOptions& options, int threads) {
  auto prepared = std::make_unique<PreparedScan>();
  PointCloud& cloud = prepared->cloud;
  cloud = std::move(scan);
  CorrectElevation(options.elevation_correction_deg, &cloud);
  if (options.voxel_m > 0) {
    cloud = VoxelFilter(cloud, options.voxel_m);
  }
  const NeighborSearch search(cloud.View(), threads);
  if ((needs & (kSourceNormal | kTargetNormal)) != 0) {
    EstimateNormals(search, options.normals, threads, &cloud);
  }
  prepared->clouds.points.emplace(cloud, search);
  if ((needs & (kTargetLine | kTargetPatch)) != 0) {
    if (options.features.smoothness.neighborhood == SmoothnessNeighborhood::kRing ||
        options.features.caps.regions_per_ring > 0) {
      RecoverRings(&cloud);
    }
    prepared->features = ExtractFeatures(cloud, options.features, threads);
    prepared->edges = cloud.Select(prepared->features.edge);
    prepared->planar = cloud.Select(prepared->features.planar);
    prepared->clouds.edges.emplace(prepared->edges, threads);
    prepared->clouds.planar.emplace(prepared->planar, threads);
  }
  return prepared;
}

}  // namespace icpscape
