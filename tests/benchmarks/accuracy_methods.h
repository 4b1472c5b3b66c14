// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_METHODS_H_
#define ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_METHODS_H_

#include <functional>
#include <string>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// A way to register two clouds, on one thread; with normals, covariances and trees, if it needs
/// them.
struct AccuracyMethod {
  std::string name;
  /// Where it ended. May be called from several threads at once.
  std::function<SE3d(const PointCloud& source, const PointCloud& target, const SE3d& T_start)> run;
};

/// The names of those that the bars speak of.
inline constexpr char kRobustMethod[] = "robust";
inline constexpr char kUngatedMethod[] = "point_to_plane";
inline constexpr char kGatedMethod[] = "point_to_plane, gate 1 m";
inline constexpr char kHuberMethod[] = "point_to_plane, gate 1 m, Huber 0.1 m";

/// This library's.
std::vector<AccuracyMethod> OurMethods();

/// PCL's, and Open3D's where it is installed.
std::vector<AccuracyMethod> PeerMethods();

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_ACCURACY_METHODS_H_
