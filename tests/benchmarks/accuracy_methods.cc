// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/accuracy_methods.h"

#include <utility>

#include "icpscape/api/register.h"
#include "icpscape/objective/loss.h"
#include "tests/benchmarks/open3d_peer.h"
#include "tests/benchmarks/pcl_peer.h"

namespace icpscape {
namespace {

// What Open3D's and PCL's pages on lidar scans take.
constexpr double kPeerGateM = 1;
constexpr int kIterations = 50;
constexpr int kOpen3dNeighbors = 30;
constexpr double kOpen3dMinChange = 1e-6;  // Its default.

AccuracyMethod Ours(const std::string& name, const RegisterOptions& options) {
  return {name, [options](const PointCloud& source, const PointCloud& target, const SE3d& T_start) {
            const Registration registration(PrepareClouds(source, target, options), options.metrics,
                                            options.weights, options.objective, options.preset, 1);
            const MinimizerSummary summary = registration.Run(T_start, options.minimizer).summary;
            return summary.Usable() ? summary.T_target_source() : T_start;
          }};
}

RegisterOptions Gated(double gate_m) {
  RegisterOptions options;
  options.objective.matching.max_distance_m = gate_m;
  return options;
}

}  // namespace

std::vector<AccuracyMethod> OurMethods() {
  RegisterOptions symmetric;
  symmetric.metrics = {"symmetric"};
  RegisterOptions huber = Gated(1);
  huber.objective.loss = MakeLoss("huber", 0.1);
  return {Ours(kUngatedMethod, RegisterOptions()),
          Ours("symmetric", symmetric),
          Ours(kGatedMethod, Gated(1)),
          Ours(kHuberMethod, huber),
          Ours("point_to_plane, gate 2 m", Gated(2)),
          Ours(kRobustMethod, RegisterOptions::Robust())};
}

std::vector<AccuracyMethod> PeerMethods() {
  std::vector<AccuracyMethod> methods = {
      {"PCL ICP",
       [](const PointCloud& source, const PointCloud& target, const SE3d& T_start) {
         return PclIcp(MakePclCloud(source), MakePclCloud(target), T_start, kIterations);
       }},
      {"PCL GICP, its gate of 5 m",
       [](const PointCloud& source, const PointCloud& target, const SE3d& T_start) {
         return PclGicp(MakePclCloud(source), MakePclCloud(target), 5, T_start);
       }},
      {"PCL GICP, gate 1 m",
       [](const PointCloud& source, const PointCloud& target, const SE3d& T_start) {
         return PclGicp(MakePclCloud(source), MakePclCloud(target), kPeerGateM, T_start);
       }}};
  if (!Open3dVersion().empty()) {
    methods.push_back({"Open3D point-to-plane, gate 1 m",
                       [](const PointCloud& source, const PointCloud& target, const SE3d& T_start) {
                         return Open3dPointToPlane(
                             MakeOpen3dCloud(source),
                             WithOpen3dNormals(MakeOpen3dCloud(target), kOpen3dNeighbors, 1),
                             kPeerGateM, T_start, {kIterations, kOpen3dMinChange}, 1);
                       }});
    methods.push_back({"Open3D GICP, gate 1 m",
                       [](const PointCloud& source, const PointCloud& target, const SE3d& T_start) {
                         return Open3dGicp(MakeOpen3dCloud(source), MakeOpen3dCloud(target),
                                           kPeerGateM, T_start, {kIterations, kOpen3dMinChange}, 1);
                       }});
  }
  return methods;
}

}  // namespace icpscape
