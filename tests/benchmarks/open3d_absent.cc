// SPDX-License-Identifier: BSD-3-Clause
#include <glog/logging.h>

#include "tests/benchmarks/open3d_peer.h"

// Replaces open3d_peer.cc where Open3D is not installed.

namespace icpscape {
namespace {
constexpr char kAbsent[] = "built without Open3D; expected tools/setup.sh --with-benchmarks before";
}

std::string Open3dVersion() { return ""; }

struct Open3dTree::Impl {};
Open3dTree::Open3dTree(const Open3dCloud& /*cloud*/) { LOG(FATAL) << kAbsent; }
Open3dTree::~Open3dTree() = default;
Open3dTree::Open3dTree(Open3dTree&&) noexcept = default;
void Open3dTree::Nearest(const Open3dCloud& /*queries*/, int /*threads*/,
                         NearestResult* /*result*/) const {
  LOG(FATAL) << kAbsent;
}

Open3dCloud MakeOpen3dCloud(const PointCloud& /*cloud*/) { LOG(FATAL) << kAbsent; }
Open3dCloud WithOpen3dNormals(const Open3dCloud& /*cloud*/, int /*num_neighbors*/,
                              int /*threads*/) {
  LOG(FATAL) << kAbsent;
}
std::vector<Eigen::Vector3f> Open3dNormals(const Open3dCloud& /*cloud*/) { LOG(FATAL) << kAbsent; }
std::size_t Open3dVoxelFilter(const Open3dCloud& /*cloud*/, double /*voxel_size_m*/) {
  LOG(FATAL) << kAbsent;
}
SE3d Open3dPointToPlane(const Open3dCloud& /*source*/, const Open3dCloud& /*target*/,
                        double /*gate_m*/, const SE3d& /*T_start*/, const Open3dStop& /*stop*/,
                        int /*threads*/) {
  LOG(FATAL) << kAbsent;
}
SE3d Open3dGicp(const Open3dCloud& /*source*/, const Open3dCloud& /*target*/, double /*gate_m*/,
                const SE3d& /*T_start*/, const Open3dStop& /*stop*/, int /*threads*/) {
  LOG(FATAL) << kAbsent;
}

}  // namespace icpscape
