// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "icpscape/cloud/normals.h"
#include "tests/benchmarks/check.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/open3d_peer.h"
#include "tests/benchmarks/pcl_peer.h"
#include "tests/benchmarks/rows.h"

namespace icpscape {

// Each side builds its tree.
void RegisterNormals(const BenchmarkPair& pair, int rounds) {
  constexpr int kNeighbors = 20;
  const auto run_ours = [](int threads, PointCloud* cloud) {
    NeighborhoodOptions options;
    options.num_neighbors = kNeighbors;
    EstimateNormals(options, threads, cloud);
  };
  const auto cloud = std::make_shared<PointCloud>(pair.target);
  const auto theirs = std::make_shared<std::vector<Eigen::Vector3f>>();
  const PclCloud pcl_cloud = MakePclCloud(pair.target);
  for (const int threads : {1, 2}) {
    const std::string title = "20-neighbour normals, " + ThreadsTitle(threads);
    const Side ours = {"icpscape", [=] { run_ours(threads, cloud.get()); }};
    Register(
        {"normals/" + ThreadsName(threads) + "/pcl",
         title,
         FromAvx2(),
         ours,
         {"PCL NormalEstimationOMP", [=] { *theirs = PclNormals(pcl_cloud, kNeighbors, threads); }},
         [=] { CheckNormals("PCL", *cloud, *theirs); }},
        rounds);
    if (!Open3dVersion().empty()) {
      const auto estimated = std::make_shared<Open3dCloud>();
      const Open3dCloud open3d_cloud = MakeOpen3dCloud(pair.target);
      Register(
          {"normals/" + ThreadsName(threads) + "/open3d",
           title,
           FromAvx2(),
           ours,
           {"Open3D", [=] { *estimated = WithOpen3dNormals(open3d_cloud, kNeighbors, threads); }},
           [=] { CheckNormals("Open3D", *cloud, Open3dNormals(*estimated)); }},
          rounds);
    }
  }
  const auto on_one_thread = std::make_shared<PointCloud>(pair.target);
  Register({"normals/threads",
            "20-neighbour normals, 2 threads",
            true,
            {"icpscape", [=] { run_ours(2, cloud.get()); }},
            {"icpscape, 1 thread", [=] { run_ours(1, on_one_thread.get()); }},
            [=] {
              for (const auto component : {&PointCloud::nx, &PointCloud::ny, &PointCloud::nz}) {
                const std::vector<float>& two = (*cloud).*component;
                const std::vector<float>& one = (*on_one_thread).*component;
                CheckValues("normals on 1 thread", {two.begin(), two.end()},
                            {one.begin(), one.end()}, 0);
              }
            }},
           rounds);
}

}  // namespace icpscape
