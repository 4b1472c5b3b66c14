// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "icpscape/common/parallel.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "tests/benchmarks/closed_loops.h"

namespace icpscape {
namespace {

// The upper triangle of sum J^T J row by row, sum J^T r, and 1/2 sum r^2.
struct Sums {
  double hessian[21] = {};
  double gradient[6] = {};
  double cost = 0;

  void Add(const Sums& other) {
    std::transform(hessian, hessian + 21, other.hessian, hessian, std::plus<>());
    std::transform(gradient, gradient + 6, other.gradient, gradient, std::plus<>());
    cost += other.cost;
  }
};

Sums SumsOf(const PointCloud& source, const PointCloud& target, const Matches& matches,
            const SE3d& T, std::size_t begin, std::size_t end) {
  const Mat3 R = T.R();
  const Mat3 R_t = R.transpose();
  Sums sums;
  for (std::size_t i = begin; i < end; ++i) {
    if (matches.target_index[i] < 0) {
      continue;
    }
    const auto j = static_cast<std::size_t>(matches.target_index[i]);
    const Vec3 p = source.Point(i);
    const Vec3 n = target.Normal(j);
    const double r = n.dot(R * p + T.t() - target.Point(j));
    const Vec3 a = R_t * n;
    const double J[6] = {p.y() * a.z() - p.z() * a.y(),
                         p.z() * a.x() - p.x() * a.z(),
                         p.x() * a.y() - p.y() * a.x(),
                         a.x(),
                         a.y(),
                         a.z()};
    double* h = sums.hessian;
    for (int row = 0; row < 6; ++row) {
      sums.gradient[row] += J[row] * r;
      for (int column = row; column < 6; ++column) {
        *h++ += J[row] * J[column];
      }
    }
    sums.cost += 0.5 * r * r;
  }
  return sums;
}

Sums SumsOf(const PointCloud& source, const PointCloud& target, const Matches& matches,
            const SE3d& T, int threads) {
  constexpr std::size_t kChunk = 4096;
  std::vector<Sums> parts((source.size() + kChunk - 1) / kChunk);
  ParallelFor(parts.size(), threads, [&](std::size_t part) {
    const std::size_t end = std::min(source.size(), (part + 1) * kChunk);
    parts[part] = SumsOf(source, target, matches, T, part * kChunk, end);
  });
  Sums sums;
  for (const Sums& part : parts) {
    sums.Add(part);
  }
  return sums;
}

Vec6 GaussNewtonStep(const Sums& sums) {
  Mat6 hessian;
  const double* h = sums.hessian;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      hessian(row, column) = hessian(column, row) = *h++;
    }
  }
  return -hessian.ldlt().solve(Eigen::Map<const Vec6>(sums.gradient));
}

}  // namespace

LoopResult RegisterByHand(const PointCloud& source, const PointCloud& target, int threads) {
  MatchingOptions matching;
  matching.max_distance_m = kLoopGateM;
  const ClosestPointMatcher matcher({source, threads}, {target, threads}, matching);
  LoopResult result;
  Matches matches;
  for (;;) {
    matcher.Match(result.T_target_source, threads, &matches);
    ++result.matching_passes;
    const Sums sums = SumsOf(source, target, matches, result.T_target_source, threads);
    result.cost = sums.cost;
    const SE3d step = SE3d::Exp(GaussNewtonStep(sums));
    if ((step.t().norm() < kLoopMinStepM && step.LogRotation().norm() < kLoopMinStepRad) ||
        result.matching_passes > kLoopMaxIterations) {
      return result;
    }
    result.T_target_source = (result.T_target_source * step).Normalized();
  }
}

}  // namespace icpscape
