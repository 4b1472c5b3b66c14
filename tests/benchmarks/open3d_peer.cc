// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/open3d_peer.h"

#include <omp.h>
#include <open3d/Open3DConfig.h>
#include <open3d/geometry/KDTreeFlann.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/GeneralizedICP.h>
#include <open3d/pipelines/registration/Registration.h>

#include "icpscape/common/parallel.h"

namespace icpscape {

using open3d::geometry::KDTreeFlann;
using open3d::geometry::KDTreeSearchParamKNN;
namespace registration = open3d::pipelines::registration;

struct Open3dCloudData {
  open3d::geometry::PointCloud cloud;
};

namespace {

registration::ICPConvergenceCriteria Criteria(const Open3dStop& stop) {
  return {stop.min_change, stop.min_change, stop.iterations};
}

SE3d PoseOf(const registration::RegistrationResult& result) {
  const Eigen::Matrix4d& T = result.transformation_;
  return SE3d(T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()).Normalized();
}

}  // namespace

std::string Open3dVersion() { return OPEN3D_VERSION; }

Open3dCloud MakeOpen3dCloud(const PointCloud& cloud) {
  auto data = std::make_shared<Open3dCloudData>();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    data->cloud.points_.push_back(cloud.Point(i));
    if (cloud.has_normals()) {
      data->cloud.normals_.push_back(cloud.Normal(i));
    }
  }
  return data;
}

struct Open3dTree::Impl {
  Open3dCloud cloud;  // The tree refers to its points.
  KDTreeFlann tree;
};

Open3dTree::Open3dTree(const Open3dCloud& cloud) : impl_(std::make_unique<Impl>()) {
  impl_->cloud = cloud;
  impl_->tree.SetGeometry(cloud->cloud);
}
Open3dTree::~Open3dTree() = default;
Open3dTree::Open3dTree(Open3dTree&&) noexcept = default;

void Open3dTree::Nearest(const Open3dCloud& queries, int threads, NearestResult* result) const {
  constexpr std::size_t kChunk = 4096;
  const std::vector<Eigen::Vector3d>& points = queries->cloud.points_;
  ParallelFor((points.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    std::vector<int> index(1);
    std::vector<double> squared_distance(1);
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      impl_->tree.SearchKNN(points[i], 1, index, squared_distance);
      result->index[i] = index[0];
      result->squared_distance[i] = static_cast<float>(squared_distance[0]);
    }
  });
}

Open3dCloud WithOpen3dNormals(const Open3dCloud& cloud, int num_neighbors, int threads) {
  omp_set_num_threads(threads);
  auto out = std::make_shared<Open3dCloudData>();
  out->cloud.points_ = cloud->cloud.points_;
  out->cloud.EstimateNormals(KDTreeSearchParamKNN(num_neighbors));
  return out;
}

std::vector<Eigen::Vector3f> Open3dNormals(const Open3dCloud& cloud) {
  std::vector<Eigen::Vector3f> out;
  for (const Eigen::Vector3d& normal : cloud->cloud.normals_) {
    out.push_back(normal.cast<float>());
  }
  return out;
}

std::size_t Open3dVoxelFilter(const Open3dCloud& cloud, double voxel_size_m) {
  return cloud->cloud.VoxelDownSample(voxel_size_m)->points_.size();
}

SE3d Open3dPointToPlane(const Open3dCloud& source, const Open3dCloud& target, double gate_m,
                        const SE3d& T_start, const Open3dStop& stop, int threads) {
  omp_set_num_threads(threads);
  return PoseOf(registration::RegistrationICP(
      source->cloud, target->cloud, gate_m, T_start.Matrix(),
      registration::TransformationEstimationPointToPlane(), Criteria(stop)));
}

SE3d Open3dGicp(const Open3dCloud& source, const Open3dCloud& target, double gate_m,
                const SE3d& T_start, const Open3dStop& stop, int threads) {
  omp_set_num_threads(threads);
  return PoseOf(registration::RegistrationGeneralizedICP(
      source->cloud, target->cloud, gate_m, T_start.Matrix(),
      registration::TransformationEstimationForGeneralizedICP(), Criteria(stop)));
}

}  // namespace icpscape
