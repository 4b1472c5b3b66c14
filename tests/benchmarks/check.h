// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_CHECK_H_
#define ICPSCAPE_TESTS_BENCHMARKS_CHECK_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "icpscape/cloud/point_cloud.h"
#include "tests/benchmarks/nearest.h"

namespace icpscape {

// Each function throws Mismatch, naming the peer and the place, where the two answers differ.

/// Equal squared distances up to a relative tolerance (0: bit for bit), and indices that have them;
/// rounding may choose between equally near points.
void CheckNearest(const std::string& peer, const PointCloud& target, const PointCloud& queries,
                  const NearestResult& ours, const NearestResult& theirs, double tolerance);

/// Equal directions up to the sign, within 0.1 degrees, wherever the neighbourhood has one normal:
/// the two smallest eigenvalues differ by a tenth of the greatest. One in a thousand may be off:
/// where neighbours are equally far, libraries choose differently.
void CheckNormals(const std::string& peer, const PointCloud& ours,
                  const std::vector<Eigen::Vector3f>& theirs);

/// As many points, and each of ours within 1 mm of one of theirs.
void CheckCentroids(const std::string& peer, const PointCloud& ours, const PointCloud& theirs);

/// Equal values up to a relative tolerance (0: bit for bit).
void CheckValues(const std::string& peer, const std::vector<double>& ours,
                 const std::vector<double>& theirs, double tolerance);

void CheckPoses(const std::string& peer, const SE3d& ours, const SE3d& theirs, double limit_m,
                double limit_deg);

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_CHECK_H_
