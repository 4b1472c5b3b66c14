// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <memory>

#include "icpscape/filtering/voxel_filter.h"
#include "tests/benchmarks/check.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/open3d_peer.h"
#include "tests/benchmarks/pcl_peer.h"
#include "tests/benchmarks/rows.h"

namespace icpscape {

void RegisterVoxelFilter(const BenchmarkPair& pair, int rounds) {
  constexpr double kVoxelM = 0.25;
  const std::string title = "voxel filter, 0.25 m, 1 thread";
  const auto filtered = std::make_shared<PointCloud>();
  PointCloud points;  // Normals and the like cost the peers nothing either.
  points.x = pair.target.x, points.y = pair.target.y, points.z = pair.target.z;
  const Side ours = {"icpscape", [=] { *filtered = VoxelFilter(points, kVoxelM); }};
  const PclCloud pcl_cloud = MakePclCloud(points);
  const auto theirs = std::make_shared<PointCloud>();
  Register({"voxel_filter/pcl",
            title,
            false,
            ours,
            {"PCL", [=] { *theirs = PclVoxelFilter(pcl_cloud, static_cast<float>(kVoxelM)); }},
            [=] { CheckCentroids("PCL", *filtered, *theirs); }},
           rounds);
  if (!Open3dVersion().empty()) {
    const Open3dCloud open3d_cloud = MakeOpen3dCloud(points);
    const auto count = std::make_shared<std::size_t>();
    Register({"voxel_filter/open3d",
              title,
              false,
              ours,
              {"Open3D", [=] { *count = Open3dVoxelFilter(open3d_cloud, kVoxelM); }},
              // Its voxels begin elsewhere: about as many points, at other places.
              [=] {
                CheckValues("Open3D", {static_cast<double>(filtered->size())},
                            {static_cast<double>(*count)}, 0.03);
              }},
             rounds);
  }
}

}  // namespace icpscape
