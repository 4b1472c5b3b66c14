// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_LOCAL_MAP_H_
#define ICPSCAPE_SRC_ODOMETRY_LOCAL_MAP_H_

#include "icpscape/odometry/voxel_map.h"
#include "icpscape/preparation/prepared_scan.h"

namespace icpscape {

struct LocalMapOptions {
  double voxel_m = 0.5;  ///< One point per voxel; of edges and of planar points likewise.
  double radius_m = 80;  ///< Points farther from the vehicle are dropped, or never come in.
  /// Only points of this many last scans, whether or not all of them went into the map; 0 is no
  /// limit. 1 is the paper's.
  int scans = 0;
};

/// The surroundings as the last scans saw them: all points, edges, and planar points, as in LOAM's
/// mapping; only those that are needed.
class LocalMap {
 public:
  /// `needs` is the union of what the metrics need; all points are kept where one of them is of
  /// closest points.
  LocalMap(const LocalMapOptions& options, bool points, unsigned needs);

  /// Adds a scan, and drops what is too far away or too old.
  void Insert(const PreparedScan& scan, const SE3d& T_world_lidar, int scan_number);

  /// The map as the target of a registration, in the frame of a pose near which it is needed: float
  /// coordinates stay small.
  MetricClouds ViewFrom(const SE3d& T_world_frame, int threads) const;

 private:
  LocalMapOptions options_;
  bool needs_points_, needs_edges_, needs_planar_;
  VoxelMap points_, edges_, planar_;
  Vec3 sensor_ = Vec3::Zero();  // In the lidar's frame, the same for all scans.
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_LOCAL_MAP_H_
