// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/check.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/text.h"
#include "tests/benchmarks/comparison.h"

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;

void Require(bool good, const std::string& message) {
  if (!good) {
    throw Mismatch(message);
  }
}

bool Near(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

std::string Pair(double ours, double theirs) {
  return Number(ours) + " and " + Number(theirs) + " (theirs)";
}

}  // namespace

void CheckNearest(const std::string& peer, const PointCloud& target, const PointCloud& queries,
                  const NearestResult& ours, const NearestResult& theirs, double tolerance) {
  Require(ours.index.size() == theirs.index.size(), peer + ": other queries.");
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const std::string place = peer + ": query " + std::to_string(i) + ", squared distance ";
    Require(Near(ours.squared_distance[i], theirs.squared_distance[i], tolerance),
            place + Pair(ours.squared_distance[i], theirs.squared_distance[i]) + ".");
    if (ours.index[i] != theirs.index[i]) {
      const Vec3 q = target.Point(static_cast<std::size_t>(theirs.index[i]));
      const double theirs_again = (queries.Point(i) - q).squaredNorm();
      Require(Near(ours.squared_distance[i], theirs_again, std::max(tolerance, 1e-6)),
              place + Pair(ours.squared_distance[i], theirs_again) + " of another point.");
    }
  }
}

void CheckNormals(const std::string& peer, const PointCloud& ours,
                  const std::vector<Eigen::Vector3f>& theirs) {
  Require(ours.size() == theirs.size(), peer + ": other normals.");
  const std::vector<Mat3> covariances = EstimateCovariances(ours, NeighborhoodOptions(), 2);
  std::size_t clear = 0;
  std::size_t off = 0;
  double worst_deg = 0;
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    eigen.computeDirect(covariances[i], Eigen::EigenvaluesOnly);
    const Vec3& lambda = eigen.eigenvalues();
    if (!(lambda[1] - lambda[0] > 0.1 * lambda[2])) {
      continue;
    }
    ++clear;
    const Vec3 n = theirs[i].cast<double>();
    const double angle_deg =
        kDegrees * std::atan2(ours.Normal(i).cross(n).norm(), std::abs(ours.Normal(i).dot(n)));
    off += angle_deg <= 0.1 ? 0 : 1;  // NaN is off.
    worst_deg = std::max(worst_deg, angle_deg);
  }
  Require(clear > theirs.size() / 4 && off * 1000 <= clear,
          peer + ": " + std::to_string(off) + " of " + std::to_string(clear) +
              " clear normals are off, by up to " + Number(worst_deg) + " degrees.");
}

void CheckCentroids(const std::string& peer, const PointCloud& ours, const PointCloud& theirs) {
  Require(ours.size() == theirs.size(), peer + ": " + std::to_string(ours.size()) + " and " +
                                            std::to_string(theirs.size()) + " (theirs) points.");
  const NeighborSearch search(theirs.View());
  const NearestResult nearest = NearestOfAll(search, ours);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    Require(nearest.squared_distance[i] <= 1e-6F,
            peer + ": no such centroid as point " + std::to_string(i) + ".");
  }
}

void CheckValues(const std::string& peer, const std::vector<double>& ours,
                 const std::vector<double>& theirs, double tolerance) {
  Require(ours.size() == theirs.size(), peer + ": another number of values.");
  for (std::size_t i = 0; i < ours.size(); ++i) {
    Require(Near(ours[i], theirs[i], tolerance),
            peer + ": value " + std::to_string(i) + " is " + Pair(ours[i], theirs[i]) + ".");
  }
}

void CheckPoses(const std::string& peer, const SE3d& ours, const SE3d& theirs, double limit_m,
                double limit_deg) {
  const SE3d difference = theirs.Inverse() * ours;
  const double off_m = difference.t().norm();
  const double off_deg = difference.LogRotation().norm() * kDegrees;
  Require(off_m <= limit_m && off_deg <= limit_deg,
          peer + ": the poses differ by " + Number(off_m) + " m, " + Number(off_deg) + " degrees.");
}

}  // namespace icpscape
