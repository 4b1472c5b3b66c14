// SPDX-License-Identifier: BSD-3-Clause
#include "src/cloud/normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "src/common/parallel.h"
#include "src/neighbors/neighbor_search.h"

namespace icpscape {
namespace {

constexpr std::size_t kChunk = 1024;

// Calls use(i, covariance, valid) for every point, from many threads.
template <class Use>
void ForEachCovariance(const PointCloud& cloud, const NeighborhoodOptions& options, int threads,
                       const Use& use) {
  const NeighborSearch search(cloud.View());
  const std::size_t chunks = (cloud.size() + kChunk - 1) / kChunk;
  ParallelFor(chunks, threads, [&](std::size_t chunk) {
    std::vector<Neighbor> neighbors;
    const std::size_t end = std::min(cloud.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const Eigen::Vector3f query(cloud.x[i], cloud.y[i], cloud.z[i]);
      if (options.radius_m > 0) {
        search.WithinRadius(query, static_cast<float>(options.radius_m), &neighbors);
      } else {
        search.KNearest(query, options.num_neighbors, &neighbors);
      }
      // Moments about the point, not the origin: no digits lost far out.
      Vec3 sum = Vec3::Zero();
      Mat3 squares = Mat3::Zero();
      for (const Neighbor& neighbor : neighbors) {
        const Vec3 d = cloud.Point(static_cast<std::size_t>(neighbor.index)) - cloud.Point(i);
        sum += d;
        squares += d * d.transpose();
      }
      const double count = static_cast<double>(neighbors.size());
      const Vec3 mean = sum / count;
      use(i, Mat3(squares / count - mean * mean.transpose()), neighbors.size() >= 3);
    }
  });
}

}  // namespace

std::vector<Eigen::Matrix3d> EstimateCovariances(const PointCloud& cloud,
                                                 const NeighborhoodOptions& options, int threads) {
  std::vector<Eigen::Matrix3d> covariances(cloud.size());
  ForEachCovariance(cloud, options, threads, [&](std::size_t i, const Mat3& C, bool valid) {
    covariances[i] = valid ? C : Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
  });
  return covariances;
}

std::size_t EstimateNormals(const NeighborhoodOptions& options, int threads, PointCloud* cloud) {
  const std::size_t size = cloud->size();
  std::vector<float> nx(size), ny(size), nz(size);
  ForEachCovariance(*cloud, options, threads, [&](std::size_t i, const Mat3& C, bool valid) {
    if (!valid) {
      return;
    }
    Eigen::SelfAdjointEigenSolver<Mat3> eigen;
    eigen.computeDirect(C);
    // On a line every direction across it is as good: no normal. The closed form finds a double
    // eigenvalue to about 1e-8 of the largest; a line 1 m long and 0.3 mm thick is still one.
    if (!(eigen.eigenvalues()[1] > 1e-7 * eigen.eigenvalues()[2])) {
      return;
    }
    Vec3 n = eigen.eigenvectors().col(0);
    if (n.dot(cloud->Point(i)) > 0) {
      n = -n;
    }
    nx[i] = static_cast<float>(n.x());
    ny[i] = static_cast<float>(n.y());
    nz[i] = static_cast<float>(n.z());
  });
  cloud->nx = std::move(nx);
  cloud->ny = std::move(ny);
  cloud->nz = std::move(nz);
  std::size_t without = 0;
  for (std::size_t i = 0; i < size; ++i) {
    without += cloud->NormalIsValid(i) ? 0 : 1;
  }
  return without;
}

}  // namespace icpscape
