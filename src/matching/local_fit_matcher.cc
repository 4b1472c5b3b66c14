// SPDX-License-Identifier: BSD-3-Clause
#include "src/matching/local_fit_matcher.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "src/common/error.h"
#include "src/common/parallel.h"
#include "src/common/text.h"

namespace icpscape {

const std::vector<std::string>& EigenvalueScaleNames() {
  static const std::vector<std::string> names = {"scatter", "over_n", "over_n_minus_one"};
  return names;
}

EigenvalueScale EigenvalueScaleFromName(const std::string& name) {
  return static_cast<EigenvalueScale>(
      IndexOfName("eigenvalue scale", name, EigenvalueScaleNames()));
}

const std::vector<std::string>& FitAnchorNames() {
  static const std::vector<std::string> names = {"centroid", "nearest"};
  return names;
}

FitAnchor FitAnchorFromName(const std::string& name) {
  return static_cast<FitAnchor>(IndexOfName("fit anchor", name, FitAnchorNames()));
}

LocalFitMatcher::LocalFitMatcher(Shape shape, const PointCloud& source, const PointCloud& target,
                                 const LocalFitOptions& options)
    : Matcher(source, target), shape_(shape), options_(options), search_(target.View()) {
  if (options.num_neighbors < 3) {
    throw UsageError("neighbours of a fit " + std::to_string(options.num_neighbors) +
                     ": expected at least 3.");
  }
  if (!(options.triangle_leg_m > 0)) {
    throw UsageError("legs of the patch's triangle " + Number(options.triangle_leg_m) +
                     " m: expected a positive length.");
  }
}

bool LocalFitMatcher::Fit(const Eigen::Vector3f& query, const std::vector<Neighbor>& neighbors,
                          LocalFit* fit) const {
  if (static_cast<int>(neighbors.size()) < options_.num_neighbors) {
    return false;
  }
  const double gate = options_.max_neighbor_distance_m;
  if (gate > 0 && neighbors.back().squared_distance > gate * gate) {
    return false;
  }
  const Vec3 origin = query.cast<double>();
  Vec3 sum = Vec3::Zero();
  Mat3 squares = Mat3::Zero();
  for (const Neighbor& neighbor : neighbors) {
    const Vec3 d = target().Point(static_cast<std::size_t>(neighbor.index)) - origin;
    sum += d;
    squares += d * d.transpose();
  }
  const double n = static_cast<double>(neighbors.size());
  const Vec3 mean = sum / n;
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(squares - n * mean * mean.transpose());
  Vec3 lambda = eigen.eigenvalues().cwiseMax(0);  // Ascending.
  switch (options_.eigenvalue_scale) {
    case EigenvalueScale::kScatter:
      break;
    case EigenvalueScale::kOverN:
      lambda /= n;
      break;
    case EigenvalueScale::kOverNMinusOne:
      lambda /= n - 1;
      break;
  }
  if (shape_ == Shape::kLine) {
    if (!(lambda[2] > options_.eigenvalue_ratio * lambda[1])) {
      return false;
    }
    fit->direction = eigen.eigenvectors().col(2);
  } else {
    if (!(lambda[1] > options_.eigenvalue_ratio * lambda[0] &&
          lambda[0] < options_.max_smallest_eigenvalue_m2)) {
      return false;
    }
    fit->direction = eigen.eigenvectors().col(0);
  }
  fit->anchor = options_.anchor == FitAnchor::kCentroid
                    ? Vec3(origin + mean)
                    : target().Point(static_cast<std::size_t>(neighbors.front().index));
  return true;
}

void LocalFitMatcher::Match(const SE3d& T, int threads, Matches* matches) const {
  constexpr std::size_t kChunk = 1024;
  matches->target_index.assign(source().size(), -1);
  matches->fits.resize(source().size());
  matches->area_patch = options_.triangle_leg_m * options_.triangle_leg_m;
  ParallelFor((source().size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    std::vector<Neighbor> neighbors;
    const std::size_t end = std::min(source().size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      const Eigen::Vector3f query = Query(T, source(), i);
      search_.KNearest(query, options_.num_neighbors, &neighbors);
      if (Fit(query, neighbors, &matches->fits[i])) {
        matches->target_index[i] = neighbors.front().index;
      }
    }
  });
}

}  // namespace icpscape
