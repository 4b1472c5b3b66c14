// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_NORMALS_H_
#define ICPSCAPE_SRC_CLOUD_NORMALS_H_

#include <Eigen/Core>
#include <vector>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/neighbors/neighbor_search.h"

namespace icpscape {

/// Which points make up a point's neighbourhood; the point itself always belongs to it.
struct NeighborhoodOptions {
  /// The k nearest, the point included. 20 is what small_gicp takes on full scans.
  int num_neighbors = 20;
  /// If positive: all points within this radius instead.
  double radius_m = 0;
};

/// Covariances of every point's neighbourhood about its mean, divided by the number of points:
///   C = 1/k sum (p_j - mean)(p_j - mean)^T                                3x3, m^2.
/// NaN where the neighbourhood has fewer than three points.
std::vector<Eigen::Matrix3d> EstimateCovariances(const PointCloud& cloud,
                                                 const NeighborhoodOptions& options, int threads);

/// Sets the cloud's normals: the eigenvector of the covariance's smallest eigenvalue, turned
/// towards the sensor s = PointCloud::sensor (n . (p - s) <= 0). Where a neighbourhood has fewer
/// than three points, or its points all lie on one line, there is no normal and (0, 0, 0) is
/// stored. Returns the number of points without a normal.
std::size_t EstimateNormals(const NeighborhoodOptions& options, int threads, PointCloud* cloud);

/// The same, with a search over the cloud's points that was built before.
std::size_t EstimateNormals(const NeighborSearch& search, const NeighborhoodOptions& options,
                            int threads, PointCloud* cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_NORMALS_H_
