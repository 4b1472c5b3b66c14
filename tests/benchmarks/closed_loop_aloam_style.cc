// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/autodiff_cost_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <utility>

#include "tests/benchmarks/closed_loops.h"
#include "tests/benchmarks/nanoflann_peer.h"

namespace icpscape {
namespace {

struct PlaneDistance {
  Vec3 p, q, n;

  template <class S>
  bool operator()(const S* rotation, const S* translation, S* residual) const {
    const Eigen::Map<const Eigen::Quaternion<S>> R(rotation);
    const Eigen::Map<const Vec<S, 3>> t(translation);
    residual[0] = n.cast<S>().dot(R * p.cast<S>() + t - q.cast<S>());
    return true;
  }
};

}  // namespace

LoopResult RegisterALoamStyle(const PointCloud& source, const PointCloud& target) {
  const NanoflannTree tree(target);
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 translation = Vec3::Zero();
  LoopResult result;
  for (bool done = false; !done && result.matching_passes < kLoopMaxIterations;) {
    ceres::Problem problem;
    problem.AddParameterBlock(rotation.coeffs().data(), 4, new ceres::EigenQuaternionManifold);
    problem.AddParameterBlock(translation.data(), 3);
    const SE3d before(rotation.toRotationMatrix(), translation);
    ++result.matching_passes;
    for (std::size_t i = 0; i < source.size(); ++i) {
      const Vec3 p = source.Point(i);
      const Eigen::Vector3f query = (before * p).cast<float>();
      std::int32_t j = -1;
      float squared_distance = 0;
      tree.Nearest(query.data(), &j, &squared_distance);
      if (squared_distance > static_cast<float>(kLoopGateM * kLoopGateM)) {
        continue;
      }
      const auto match = static_cast<std::size_t>(j);
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PlaneDistance, 1, 4, 3>(
                                   new PlaneDistance{p, target.Point(match), target.Normal(match)}),
                               nullptr, rotation.coeffs().data(), translation.data());
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 4;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    result.T_target_source = SE3d(rotation.toRotationMatrix(), translation);
    const SE3d step = before.Inverse() * result.T_target_source;
    done = step.t().norm() < kLoopMinStepM && step.LogRotation().norm() < kLoopMinStepRad;
  }
  return result;
}

}  // namespace icpscape
