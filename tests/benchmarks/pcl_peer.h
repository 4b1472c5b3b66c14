// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_PCL_PEER_H_
#define ICPSCAPE_TESTS_BENCHMARKS_PCL_PEER_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "icpscape/cloud/point_cloud.h"
#include "tests/benchmarks/nearest.h"

namespace icpscape {

// PCL, as its tutorials use it. Its headers stay in the .cc files. Conversions to its types are
// done ahead, by PclCloud, and are not timed.

struct PclCloudData;
using PclCloud = std::shared_ptr<const PclCloudData>;
/// With the cloud's normals, where it has any.
PclCloud MakePclCloud(const PointCloud& cloud);

/// pcl::KdTreeFLANN.
class PclTree {
 public:
  explicit PclTree(const PclCloud& cloud);
  ~PclTree();
  PclTree(PclTree&&) noexcept;
  void Nearest(const PclCloud& queries, int threads, NearestResult* result) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// pcl::NormalEstimationOMP.
std::vector<Eigen::Vector3f> PclNormals(const PclCloud& cloud, int num_neighbors, int threads);

/// The cloud with those normals.
PclCloud WithPclNormals(const PclCloud& cloud, int num_neighbors, int threads);

/// pcl::VoxelGrid.
PointCloud PclVoxelFilter(const PclCloud& cloud, float voxel_size_m);

/// pcl::IterativeClosestPoint with TransformationEstimationPointToPlaneLLS from the identity, until
/// a step is below both limits. The target has normals.
SE3d PclPointToPlane(const PclCloud& source, const PclCloud& target, double gate_m,
                     double min_step_m, double min_step_rad);

/// pcl::IterativeClosestPoint, point to point, with pairs of any length, up to this many steps; it
/// ends earlier by its default rules.
SE3d PclIcp(const PclCloud& source, const PclCloud& target, const SE3d& T_start, int iterations);

/// pcl::GeneralizedIterativeClosestPoint with all else at its defaults.
SE3d PclGicp(const PclCloud& source, const PclCloud& target, double gate_m, const SE3d& T_start);

/// The landscape as one writes it first: for every pose a transformed cloud, and a search for every
/// point; one thread, one metric. Returns an RMSE per pose. The source holds the metric's points:
/// edge or planar ones for edge_to_line and planar_to_patch.
std::vector<double> PclLandscape(const std::string& metric, const PclCloud& source,
                                 const PclCloud& target, const std::vector<SE3d>& poses);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_PCL_PEER_H_
