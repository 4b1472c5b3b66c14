// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_OPEN3D_PEER_H_
#define ICPSCAPE_TESTS_BENCHMARKS_OPEN3D_PEER_H_

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "icpscape/cloud/point_cloud.h"
#include "tests/benchmarks/nearest.h"

namespace icpscape {

// Open3D's classic geometry and registration. Its headers stay in open3d_peer.cc; where Open3D is
// not installed, open3d_absent.cc takes its place and nothing but Open3dVersion may be called.

/// Empty where there is no Open3D.
std::string Open3dVersion();

struct Open3dCloudData;
using Open3dCloud = std::shared_ptr<const Open3dCloudData>;
/// With the cloud's normals, where it has any.
Open3dCloud MakeOpen3dCloud(const PointCloud& cloud);

/// open3d::geometry::KDTreeFlann.
class Open3dTree {
 public:
  explicit Open3dTree(const Open3dCloud& cloud);
  ~Open3dTree();
  Open3dTree(Open3dTree&&) noexcept;
  void Nearest(const Open3dCloud& queries, int threads, NearestResult* result) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The cloud with estimated normals, and these as such.
Open3dCloud WithOpen3dNormals(const Open3dCloud& cloud, int num_neighbors, int threads);
std::vector<Eigen::Vector3f> Open3dNormals(const Open3dCloud& cloud);

/// Returns the number of points that are left.
std::size_t Open3dVoxelFilter(const Open3dCloud& cloud, double voxel_size_m);

/// When Open3D's registrations end.
struct Open3dStop {
  int iterations;
  /// Of the fitness, and relative of the inlier RMSE; Open3D's default is 1e-6. 0: never before.
  double min_change = 0;
};

/// RegistrationICP, point-to-plane. The target has normals.
SE3d Open3dPointToPlane(const Open3dCloud& source, const Open3dCloud& target, double gate_m,
                        const SE3d& T_start, const Open3dStop& stop, int threads);

/// RegistrationGeneralizedICP, which estimates the covariances itself.
SE3d Open3dGicp(const Open3dCloud& source, const Open3dCloud& target, double gate_m,
                const SE3d& T_start, const Open3dStop& stop, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_OPEN3D_PEER_H_
