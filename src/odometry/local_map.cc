// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/local_map.h"

#include <vector>

#include "icpscape/residuals/correspondence.h"

namespace icpscape {
namespace {

// The points that are no farther from the sensor.
PointCloud Within(double radius_m, const PointCloud& scan) {
  std::vector<char> keep(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    keep[i] = (scan.Point(i) - scan.sensor).squaredNorm() <= radius_m * radius_m ? 1 : 0;
  }
  return scan.Select(keep);
}

}  // namespace

LocalMap::LocalMap(const LocalMapOptions& options, bool points, unsigned needs)
    : options_(options),
      needs_points_(points),
      needs_edges_((needs & kTargetLine) != 0),
      needs_planar_((needs & kTargetPatch) != 0),
      points_(options.voxel_m),
      edges_(options.voxel_m),
      planar_(options.voxel_m) {}

void LocalMap::Insert(const PreparedScan& scan, const SE3d& T_world_lidar, int scan_number) {
  sensor_ = scan.cloud().sensor;
  const auto insert = [&](const PointCloud& cloud, VoxelMap* map) {
    map->RemoveBeyond(T_world_lidar * sensor_, options_.radius_m);
    if (options_.scans > 0) {
      map->RemoveBefore(scan_number - options_.scans + 1);
    }
    map->Insert(Within(options_.radius_m, cloud), T_world_lidar, scan_number);
  };
  if (needs_points_) {
    insert(scan.cloud(), &points_);
  }
  if (needs_edges_) {
    insert(scan.clouds().edges->cloud(), &edges_);
  }
  if (needs_planar_) {
    insert(scan.clouds().planar->cloud(), &planar_);
  }
}

MetricClouds LocalMap::ViewFrom(const SE3d& T_world_frame, int threads) const {
  MetricClouds view;
  const auto seen = [&](const VoxelMap& map) {
    PointCloud cloud = map.Cloud(T_world_frame.Inverse());
    cloud.sensor = sensor_;
    return cloud;
  };
  if (needs_points_) {
    view.points.emplace(seen(points_), threads);
  }
  if (needs_edges_) {
    view.edges.emplace(seen(edges_), threads);
  }
  if (needs_planar_) {
    view.planar.emplace(seen(planar_), threads);
  }
  return view;
}

}  // namespace icpscape
