// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/pcl_peer.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>
#include <pcl/search/kdtree.h>

#include <cmath>

#include "icpscape/common/parallel.h"
#include "tests/benchmarks/pcl_cloud.h"

namespace icpscape {
namespace {

pcl::PointCloud<pcl::Normal>::Ptr EstimatedNormals(const PclCloud& cloud, int num_neighbors,
                                                   int threads) {
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(static_cast<unsigned>(threads));
  estimation.setInputCloud(cloud->points);
  estimation.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setKSearch(num_neighbors);
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  estimation.compute(*normals);
  return normals;
}

// The pose where `icp` ends.
template <class Point>
SE3d Align(pcl::Registration<Point, Point>* icp, const SE3d& T_start) {
  pcl::PointCloud<Point> aligned;
  icp->align(aligned, T_start.Matrix().cast<float>());
  const Eigen::Matrix4d T = icp->getFinalTransformation().template cast<double>();
  return SE3d(T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()).Normalized();
}

}  // namespace

PclCloud MakePclCloud(const PointCloud& cloud) {
  auto data = std::make_shared<PclCloudData>();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    data->points->emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
    pcl::PointNormal point;
    point.x = cloud.x[i], point.y = cloud.y[i], point.z = cloud.z[i];
    if (cloud.has_normals()) {
      point.normal_x = cloud.nx[i], point.normal_y = cloud.ny[i], point.normal_z = cloud.nz[i];
    }
    data->with_normals->push_back(point);
  }
  return data;
}

struct PclTree::Impl {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
};

PclTree::PclTree(const PclCloud& cloud) : impl_(std::make_unique<Impl>()) {
  impl_->tree.setInputCloud(cloud->points);
}
PclTree::~PclTree() = default;
PclTree::PclTree(PclTree&&) noexcept = default;

void PclTree::Nearest(const PclCloud& queries, int threads, NearestResult* result) const {
  constexpr std::size_t kChunk = 4096;
  const std::size_t size = queries->points->size();
  ParallelFor((size + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    pcl::Indices index(1);
    std::vector<float> squared_distance(1);
    const std::size_t end = std::min(size, (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      impl_->tree.nearestKSearch((*queries->points)[i], 1, index, squared_distance);
      result->index[i] = index[0];
      result->squared_distance[i] = squared_distance[0];
    }
  });
}

std::vector<Eigen::Vector3f> PclNormals(const PclCloud& cloud, int num_neighbors, int threads) {
  std::vector<Eigen::Vector3f> out;
  for (const pcl::Normal& normal : *EstimatedNormals(cloud, num_neighbors, threads)) {
    out.emplace_back(normal.normal_x, normal.normal_y, normal.normal_z);
  }
  return out;
}

PclCloud WithPclNormals(const PclCloud& cloud, int num_neighbors, int threads) {
  auto out = std::make_shared<PclCloudData>();
  out->points = cloud->points;
  pcl::concatenateFields(*cloud->points, *EstimatedNormals(cloud, num_neighbors, threads),
                         *out->with_normals);
  return out;
}

PointCloud PclVoxelFilter(const PclCloud& cloud, float voxel_size_m) {
  pcl::VoxelGrid<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud->points);
  filter.setLeafSize(voxel_size_m, voxel_size_m, voxel_size_m);
  pcl::PointCloud<pcl::PointXYZ> filtered;
  filter.filter(filtered);
  PointCloud out;
  for (const pcl::PointXYZ& point : filtered) {
    out.x.push_back(point.x);
    out.y.push_back(point.y);
    out.z.push_back(point.z);
  }
  return out;
}

SE3d PclPointToPlane(const PclCloud& source, const PclCloud& target, double gate_m,
                     double min_step_m, double min_step_rad) {
  using Point = pcl::PointNormal;
  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setTransformationEstimation(
      pcl::registration::TransformationEstimationPointToPlaneLLS<Point, Point>::Ptr(
          new pcl::registration::TransformationEstimationPointToPlaneLLS<Point, Point>));
  icp.setInputSource(source->with_normals);
  icp.setInputTarget(target->with_normals);
  icp.setMaxCorrespondenceDistance(gate_m);
  icp.setTransformationEpsilon(min_step_m * min_step_m);
  icp.setTransformationRotationEpsilon(std::cos(min_step_rad));
  icp.setMaximumIterations(50);
  return Align<Point>(&icp, SE3d());
}

SE3d PclIcp(const PclCloud& source, const PclCloud& target, const SE3d& T_start, int iterations) {
  using Point = pcl::PointXYZ;
  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setInputSource(source->points);
  icp.setInputTarget(target->points);
  icp.setMaximumIterations(iterations);
  return Align<Point>(&icp, T_start);
}

SE3d PclGicp(const PclCloud& source, const PclCloud& target, double gate_m, const SE3d& T_start) {
  using Point = pcl::PointXYZ;
  pcl::GeneralizedIterativeClosestPoint<Point, Point> icp;
  icp.setInputSource(source->points);
  icp.setInputTarget(target->points);
  icp.setMaxCorrespondenceDistance(gate_m);
  return Align<Point>(&icp, T_start);
}

}  // namespace icpscape
