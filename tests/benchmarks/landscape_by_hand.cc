// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/landscape_by_hand.h"

#include <cmath>

#include "icpscape/common/parallel.h"
#include "tests/benchmarks/nanoflann_peer.h"

namespace icpscape {

std::vector<std::array<double, 3>> LandscapeByHand(const PointCloud& source,
                                                   const PointCloud& target,
                                                   const std::vector<SE3d>& poses, int threads) {
  const NanoflannTree tree(target);
  std::vector<std::array<double, 3>> rmse(poses.size());
  ParallelFor(poses.size(), threads, [&](std::size_t pose) {
    double sum[3] = {};
    long n[3] = {};
    for (std::size_t i = 0; i < source.size(); ++i) {
      const Vec3 p = poses[pose] * source.Point(i);
      const Eigen::Vector3f query = p.cast<float>();
      std::int32_t index = -1;
      float squared_distance = 0;
      tree.Nearest(query.data(), &index, &squared_distance);
      const auto j = static_cast<std::size_t>(index);
      const Vec3 e = p - target.Point(j);
      sum[0] += e.squaredNorm();
      ++n[0];
      if (target.NormalIsValid(j)) {
        const Vec3 n_target = target.Normal(j);
        sum[1] += e.dot(n_target) * e.dot(n_target);
        ++n[1];
        if (source.NormalIsValid(i)) {
          const double r = e.dot(n_target + source.Normal(i));
          sum[2] += r * r;
          ++n[2];
        }
      }
    }
    for (std::size_t metric = 0; metric < 3; ++metric) {
      rmse[pose][metric] = std::sqrt(sum[metric] / static_cast<double>(n[metric]));
    }
  });
  return rmse;
}

}  // namespace icpscape
