// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/covariance.h"

#include <ceres/loss_function.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "icpscape/cloud/displacement.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/covariance/pair_derivatives.h"
#include "icpscape/filtering/voxel_hash.h"
#include "icpscape/objective/pairs.h"

namespace icpscape {
namespace {

// Rotations that the rematched Hessian is differenced over move points at this distance (m) as far
// as its translations do.
constexpr double kRematchingLever = 10;

// Sums vectors by a number, and then the squares of the sums.
class Groups {
 public:
  explicit Groups(std::size_t count) : sums_(count, Vec6::Zero()) {}
  void Add(std::size_t group, const Vec6& g) { sums_[group] += g; }
  Mat6 SumOfSquares() const {
    Mat6 total = Mat6::Zero();
    for (const Vec6& sum : sums_) {
      total += sum * sum.transpose();
    }
    return total;
  }

 private:
  std::vector<Vec6> sums_;
};

// Sums what one pair after the other has.
class Scores {
 public:
  Scores(std::size_t most_pairs, double cluster_m)
      : cluster_m_(cluster_m), cubes_(most_pairs), by_cube_(most_pairs) {}

  // The pair's gradient, its part of H, its rows and its target point.
  void Add(const Vec6& g, const Mat6& gauss_newton, int rows, const Vec3& target_point) {
    sums_.gauss_newton += gauss_newton;
    sums_.scores += g * g.transpose();
    by_cube_.Add(
        cubes_.Insert(VoxelKey(target_point.cast<float>(), cluster_m_, "the target frame")), g);
    ++sums_.pairs;
    sums_.rows += rows;
  }
  ScoreSums Sums() const {
    ScoreSums sums = sums_;
    sums.cluster_scores = by_cube_.SumOfSquares();
    sums.clusters = static_cast<long>(cubes_.size());
    return sums;
  }

 private:
  double cluster_m_;
  VoxelNumbers cubes_;
  Groups by_cube_;
  ScoreSums sums_;
};

std::size_t RingCount(const PointCloud& cloud) {
  std::int32_t last = -1;
  for (const std::int32_t ring : cloud.ring) {
    last = std::max(last, ring);
  }
  return static_cast<std::size_t>(last) + 1;  // Wraps around to 0 where there is none.
}

using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// By columns: the gradient after a motion less that after its opposite, each over its own pairs.
Motions GradientChanges(const JointObjective& objective, const SE3d& T, const Motions& steps,
                        int threads) {
  const auto gradient = [&](const Vec6& xi) {
    return objective.Evaluate(T * SE3d::Exp(xi), threads).sums.gradient;
  };
  Motions changes(6, steps.cols());
  for (Eigen::Index i = 0; i < steps.cols(); ++i) {
    changes.col(i) = gradient(steps.col(i)) - gradient(-steps.col(i));
  }
  return changes;
}

// The inverse; nothing where the matrix is not positive definite to within rounding. Rotations are
// scaled to the size of translations before.
std::optional<Mat6> Inverse(const Mat6& matrix) {
  const double ratio =
      std::sqrt(matrix.topLeftCorner<3, 3>().trace() / matrix.bottomRightCorner<3, 3>().trace());
  if (!(ratio > 0) || !std::isfinite(ratio)) {
    return std::nullopt;
  }
  Vec6 scale = Vec6::Ones();
  scale.head<3>() /= ratio;
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(scale.asDiagonal() * matrix *
                                                   scale.asDiagonal());
  const Vec6& eigenvalues = solver.eigenvalues();
  if (!(eigenvalues[0] > 1e-12 * eigenvalues[5])) {
    return std::nullopt;
  }
  const Mat6 V = scale.asDiagonal() * solver.eigenvectors();
  return V * eigenvalues.cwiseInverse().asDiagonal() * V.transpose();
}

// bread^-1 middle bread^-T; nothing unless the bread is that of a minimum and the result is
// positive definite.
std::optional<Mat6> Sandwich(const Mat6& bread, const Mat6& middle) {
  if (!Inverse(0.5 * (bread + bread.transpose()))) {
    return std::nullopt;
  }
  const Mat6 inverse = bread.inverse();
  const Mat6 covariance = inverse * middle * inverse.transpose();
  return Inverse(covariance) ? std::optional(covariance) : std::nullopt;
}

}  // namespace

void CovarianceOptions::Check() const {
  const auto require = [](bool good, const char* name, double value, const char* expected) {
    if (!good) {
      throw UsageError(std::string(name) + "=" + Number(value) + ": expected " + expected + ".");
    }
  };
  require(range_noise_m >= 0 && range_noise_m <= 10, "range_noise_m", range_noise_m, "0 to 10 m");
  require(ring_bias_m >= 0 && ring_bias_m <= 10, "ring_bias_m", ring_bias_m, "0 to 10 m");
  require(cluster_m >= 0.01 && cluster_m <= 1000, "cluster_m", cluster_m, "0.01 to 1000 m");
  require(rematching_step_m >= 1e-4 && rematching_step_m <= 1, "rematching_step_m",
          rematching_step_m, "0.0001 to 1 m");
}

ScoreSums SumScores(const JointObjective& objective, const SE3d& T, const MatchesByMatcher& matches,
                    double cluster_m) {
  std::size_t most_pairs = 0;
  for (const Objective& term : objective.objectives()) {
    most_pairs += term.matcher().source().size();
  }
  Scores scores(most_pairs, cluster_m);
  for (std::size_t k = 0; k < objective.objectives().size(); ++k) {
    const Objective& term = objective.objectives()[k];
    const double weight = objective.weights()[k];
    const Matcher& matcher = term.matcher();
    const PairGradientFunction differentiate = PairGradientOf(term.metric());
    ForEachPair(term, matches.at(&matcher),
                [&](std::size_t /*i*/, std::size_t j, const Correspondence& pair) {
                  const PairGradient d = differentiate(pair, T, term.loss());
                  scores.Add(weight * d.gradient, weight * d.gauss_newton, d.rows,
                             matcher.target().Point(j));
                });
  }
  return scores.Sums();
}

CovarianceSums SumForCovariance(const Objective& objective, const SE3d& T,
                                const CovarianceOptions& options, int threads) {
  CovarianceSums sums = SumForCovariance(objective, T, objective.Match(T, threads), options);
  Vec6 steps = Vec6::Constant(options.rematching_step_m);
  steps.head<3>() /= kRematchingLever;
  const Mat6 about_sensor = AboutPoint(objective.matcher().source().sensor, 1);
  const Mat6 changes =
      GradientChanges(objective, T, about_sensor.inverse() * steps.asDiagonal(), threads);
  for (int i = 0; i < 6; ++i) {
    sums.rematched_hessian.col(i) = changes.col(i) / (2 * steps[i]);
  }
  sums.rematched_hessian *= about_sensor;
  return sums;
}

Eigen::MatrixXd RematchedHessian(const JointObjective& objective, const SE3d& T,
                                 const Motions& steps, int threads) {
  return 0.5 * steps.transpose() * GradientChanges(objective, T, steps, threads);
}

CovarianceSums SumForCovariance(const Objective& objective, const SE3d& T, const Matches& matches,
                                const CovarianceOptions& options) {
  const PairDerivativesFunction differentiate = PairDerivativesOf(objective.metric());
  const PointCloud& source = objective.matcher().source();
  const PointCloud& target = objective.matcher().target();
  const bool has_rings = !source.ring.empty() && !target.ring.empty();
  CovarianceSums sums;
  Scores scores(matches.target_index.size(), options.cluster_m);
  Groups target_ranges(target.size());
  Groups rings(has_rings ? std::max(RingCount(source), RingCount(target)) : 0);
  ForEachPair(objective, matches, [&](std::size_t i, std::size_t j, const Correspondence& pair) {
    const PairDerivatives d =
        differentiate(pair, T, objective.loss(), {source.sensor, target.sensor});
    scores.Add(d.gradient, d.gauss_newton, d.rows, target.Point(j));
    sums.hessian += d.gradient_by_xi;
    sums.range_noise += d.by_source_range * d.by_source_range.transpose();
    target_ranges.Add(j, d.by_target_range);
    if (has_rings) {
      rings.Add(static_cast<std::size_t>(source.ring[i]), d.by_source_range);
      rings.Add(static_cast<std::size_t>(target.ring[j]), d.by_target_range);
    }
  });
  static_cast<ScoreSums&>(sums) = scores.Sums();
  sums.hessian = (0.5 * (sums.hessian + sums.hessian.transpose())).eval();
  sums.range_noise += target_ranges.SumOfSquares();
  if (has_rings) {
    sums.ring_bias = rings.SumOfSquares();
  }
  sums.cost = objective.Evaluate(T, matches, 1).sums.cost;
  return sums;
}

std::optional<Mat6> EstimateCovariance(Estimator estimator, const CovarianceSums& sums,
                                       const CovarianceOptions& options) {
  // H must determine the pose: what A or B have beyond H is no information about it.
  const std::optional<Mat6> H_inverse = Inverse(sums.gauss_newton);
  if (!H_inverse) {
    return std::nullopt;
  }
  const auto square = [](double x) { return x * x; };
  switch (estimator) {
    case Estimator::kGaussNewton:
      if (sums.rows <= 6 || !(sums.cost > 0)) {
        return std::nullopt;
      }
      return 2 * sums.cost / static_cast<double>(sums.rows - 6) * *H_inverse;
    case Estimator::kCensi:
      return Sandwich(sums.hessian, square(options.range_noise_m) * sums.range_noise);
    case Estimator::kCensiRingBias:
      if (!sums.ring_bias) {
        return std::nullopt;
      }
      return Sandwich(sums.hessian, square(options.range_noise_m) * sums.range_noise +
                                        square(options.ring_bias_m) * *sums.ring_bias);
    case Estimator::kSandwich:
      return Sandwich(sums.hessian, sums.scores);
    case Estimator::kSandwichClustered:
      return Sandwich(sums.hessian, sums.cluster_scores);
    case Estimator::kSandwichRematched:
      return Sandwich(sums.rematched_hessian, sums.cluster_scores);
  }
  return std::nullopt;
}

std::string CovarianceWarning(const std::string& metric) {
  if (metric != "point_to_point") {
    return "";
  }
  return "point_to_point: the closed forms over given pairs are not valid, since along surfaces "
         "the "
         "pairs follow the pose (Bonnabel, Barczyk & Goulette 2016); trust Monte-Carlo, or at most "
         "sandwich_rematched.";
}

}  // namespace icpscape
