// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/voxel_filter.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "icpscape/filtering/voxel_hash.h"

namespace icpscape {
namespace {

// Over the points of a voxel.
struct Sums {
  double x = 0, y = 0, z = 0;
  double intensity = 0;
  double points = 0;
};

}  // namespace

PointCloud VoxelFilter(const PointCloud& cloud, double voxel_size_m) {
  CheckVoxelSize(voxel_size_m);
  const bool has_intensity = !cloud.intensity.empty();
  VoxelNumbers voxels(cloud.size());
  std::vector<Sums> sums;
  sums.reserve(cloud.size());  // Memory that is not written costs nothing; moving the sums would.
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f point(cloud.x[i], cloud.y[i], cloud.z[i]);
    const std::uint32_t voxel = voxels.Insert(VoxelKey(point, voxel_size_m, "its frame"));
    if (voxel == sums.size()) {
      sums.emplace_back();
    }
    Sums& sum = sums[voxel];
    sum.x += point.x();
    sum.y += point.y();
    sum.z += point.z();
    sum.intensity += has_intensity ? cloud.intensity[i] : 0;
    sum.points += 1;
  }
  PointCloud out;
  out.sensor = cloud.sensor;
  out.origin = cloud.origin;
  const auto averages = [&](double Sums::*sum) {
    std::vector<float> values(sums.size());
    for (std::size_t v = 0; v < sums.size(); ++v) {
      values[v] = static_cast<float>(sums[v].*sum / sums[v].points);
    }
    return values;
  };
  out.x = averages(&Sums::x);
  out.y = averages(&Sums::y);
  out.z = averages(&Sums::z);
  if (has_intensity) {
    out.intensity = averages(&Sums::intensity);
  }
  return out;
}

}  // namespace icpscape
