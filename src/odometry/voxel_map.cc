// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/voxel_map.h"

#include "icpscape/filtering/voxel_hash.h"

namespace icpscape {

void VoxelMap::Insert(const PointCloud& scan, const SE3d& T_map_scan, int scan_number) {
  has_normals_ = has_normals_ && scan.has_normals();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vec3 p = T_map_scan * scan.Point(i);
    const std::uint64_t voxel = VoxelKey(p.cast<float>(), voxel_m_, "the map's frame");
    if (voxels_.insert(voxel).second) {
      Eigen::Vector3f n = Eigen::Vector3f::Zero();
      if (scan.has_normals()) {
        n = (T_map_scan.R() * scan.Normal(i)).cast<float>();
      }
      points_.push_back({p, n, voxel, scan_number});
    }
  }
}

template <class Goes>
void VoxelMap::RemoveWhere(const Goes& goes) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (goes(points_[i])) {
      voxels_.erase(points_[i].voxel);
    } else {
      points_[kept++] = points_[i];
    }
  }
  points_.resize(kept);
}

void VoxelMap::RemoveBefore(int scan_number) {
  RemoveWhere([&](const MapPoint& point) { return point.scan_number < scan_number; });
}

void VoxelMap::RemoveBeyond(const Vec3& center, double radius_m) {
  RemoveWhere([&](const MapPoint& point) {
    return (point.p - center).squaredNorm() > radius_m * radius_m;
  });
}

PointCloud VoxelMap::Cloud(const SE3d& T_other_map) const {
  PointCloud cloud;
  const std::size_t size = points_.size();
  for (std::vector<float>* values : {&cloud.x, &cloud.y, &cloud.z}) {
    values->resize(size);
  }
  if (has_normals_) {
    for (std::vector<float>* values : {&cloud.nx, &cloud.ny, &cloud.nz}) {
      values->resize(size);
    }
  }
  const Mat3& R = T_other_map.R();
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector3f p = (T_other_map * points_[i].p).cast<float>();
    cloud.x[i] = p.x(), cloud.y[i] = p.y(), cloud.z[i] = p.z();
    if (has_normals_) {
      const Eigen::Vector3f n = (R * points_[i].n.cast<double>()).cast<float>();
      cloud.nx[i] = n.x(), cloud.ny[i] = n.y(), cloud.nz[i] = n.z();
    }
  }
  return cloud;
}

}  // namespace icpscape
