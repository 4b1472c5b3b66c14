// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/neighbors/moved_points.h"

#include "icpscape/neighbors/search_kernels.h"

namespace icpscape {

void MovedPoints::Move(const SE3d& T, const PointsView& points) {
  size_ = points.size;
  if (x_.size() < size_) {
    x_.resize(size_);
    y_.resize(size_);
    z_.resize(size_);
  }
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = T.R();
  const Vec3& t = T.t();
  SearchKernelsAt(ActiveSimdLevel())
      .move(R.data(), t.data(), points, x_.data(), y_.data(), z_.data());
}

}  // namespace icpscape
