// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/common/centroid.h>
#include <pcl/common/transforms.h>
#include <pcl/kdtree/kdtree_flann.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "icpscape/matching/local_fit_matcher.h"
#include "tests/benchmarks/pcl_cloud.h"

namespace icpscape {
namespace {

using Point = pcl::PointNormal;
using Tree = pcl::KdTreeFLANN<Point>;

// The sum and the number of terms of the paper's eps.
struct Terms {
  double sum = 0;
  long n = 0;
  void Add(double term) {
    sum += term;
    ++n;
  }
  double Rmse() const { return std::sqrt(sum / static_cast<double>(n)); }
};

bool HasNormal(const Point& p) { return p.normal_x != 0 || p.normal_y != 0 || p.normal_z != 0; }

// The printed metrics over closest points.
void AddClosestPoint(const std::string& metric, const Tree& tree, const Point& moved,
                     const Point& source, const pcl::PointCloud<Point>& target, Terms* terms) {
  pcl::Indices index(1);
  std::vector<float> squared_distance(1);
  tree.nearestKSearch(moved, 1, index, squared_distance);
  const Point& q = target[static_cast<std::size_t>(index[0])];
  const Eigen::Vector3f e = moved.getVector3fMap() - q.getVector3fMap();
  if (metric == "point_to_point") {
    terms->Add(e.squaredNorm());
  } else if (metric == "point_to_plane" && HasNormal(q)) {
    terms->Add(std::pow(e.dot(q.getNormalVector3fMap()), 2));
  } else if (metric == "symmetric" && HasNormal(q) && HasNormal(source)) {
    terms->Add(std::pow(e.dot(q.getNormalVector3fMap() + source.getNormalVector3fMap()), 2));
  }
}

// The metrics over a line or patch through the five nearest points, by the paper's rules.
void AddLocalFit(const std::string& metric, const Tree& tree, const Point& moved,
                 const pcl::PointCloud<Point>& target, Terms* terms) {
  const LocalFitOptions rules;
  pcl::Indices index;
  std::vector<float> squared_distance;
  tree.nearestKSearch(moved, rules.num_neighbors, index, squared_distance);
  Mat3 covariance = Mat3::Zero();
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  pcl::computeMeanAndCovarianceMatrix(target, index, covariance, mean);
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(covariance);
  const Vec3& lambda = eigen.eigenvalues();
  const Vec3 e = moved.getVector3fMap().cast<double>() - mean.head<3>();
  if (metric == "edge_to_line") {
    if (lambda[2] > rules.eigenvalue_ratio * lambda[1]) {
      terms->Add(eigen.eigenvectors().col(2).cross(e).norm());
    }
  } else if (lambda[1] > rules.eigenvalue_ratio * lambda[0] &&
             lambda[0] < rules.max_smallest_eigenvalue_m2) {
    const double area = rules.triangle_leg_m * rules.triangle_leg_m;
    terms->Add(std::sqrt(1 + e.squaredNorm() / (area * area)) - 1);
  }
}

}  // namespace

std::vector<double> PclLandscape(const std::string& metric, const PclCloud& source,
                                 const PclCloud& target, const std::vector<SE3d>& poses) {
  const bool fits = metric == "edge_to_line" || metric == "planar_to_patch";
  Tree tree;
  tree.setInputCloud(target->with_normals);
  std::vector<double> rmse;
  for (const SE3d& T : poses) {
    pcl::PointCloud<Point> moved;
    pcl::transformPointCloud(*source->with_normals, moved, T.Matrix());
    Terms terms;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (fits) {
        AddLocalFit(metric, tree, moved[i], *target->with_normals, &terms);
      } else {
        AddClosestPoint(metric, tree, moved[i], (*source->with_normals)[i], *target->with_normals,
                        &terms);
      }
    }
    rmse.push_back(terms.Rmse());
  }
  return rmse;
}

}  // namespace icpscape
