// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_VOXEL_MAP_H_
#define ICPSCAPE_SRC_ODOMETRY_VOXEL_MAP_H_

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Points of many scans, one per voxel of a fixed lattice: the first that came to it. A point keeps
/// the normal that its own scan gave it.
class VoxelMap {
 public:
  explicit VoxelMap(double voxel_m) : voxel_m_(voxel_m) {}

  std::size_t size() const { return points_.size(); }

  /// Adds the points of a scan whose voxels are empty, seen from this pose. Points are rounded to
  /// float only to find their voxels. Throws InputError for a point beyond 2^20 voxels from the
  /// origin.
  void Insert(const PointCloud& scan, const SE3d& T_map_scan, int scan_number);

  /// Removes the points of scans before this number, and those farther than that from a place.
  void RemoveBefore(int scan_number);
  void RemoveBeyond(const Vec3& center, double radius_m);

  /// The points in the order in which they came, seen from another frame, with their normals.
  PointCloud Cloud(const SE3d& T_other_map) const;

 private:
  struct MapPoint {
    Vec3 p;  // Map frame.
    Eigen::Vector3f n;
    std::uint64_t voxel;
    std::int32_t scan_number;
  };

  template <class Goes>
  void RemoveWhere(const Goes& goes);

  double voxel_m_;
  std::vector<MapPoint> points_;
  std::unordered_set<std::uint64_t> voxels_;  // Those of the points.
  bool has_normals_ = true;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_VOXEL_MAP_H_
