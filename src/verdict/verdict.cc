// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/verdict/verdict.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <limits>
#include <utility>

#include "icpscape/cloud/displacement.h"
#include "icpscape/common/text.h"
#include "icpscape/covariance/covariance.h"
#include "icpscape/minimizer/free_directions.h"
#include "icpscape/objective/source_centroid.h"

namespace icpscape {
namespace {

// Eigenvalues of H and of B below these shares of the largest are none.
constexpr double kLeastOfH = 1e-12;
constexpr double kLeastOfB = 1e-6;
// A limit cycle within this share of the tolerances is as good as one pose.
constexpr double kHarmlessCycle = 0.1;
// Half the distance over which gradients are differenced (m), but no more than this share of the
// cloud's radius. Long: over 2 cm the noise of a corridor's walls looks like a minimum along it,
// over 10 cm it does not, and where a scan is determined the two agree.
constexpr double kLongestStep = 0.1;
constexpr double kLongestShare = 0.02;

// The mean of the points that are matched, and their root mean square distance from it.
struct Extent {
  Vec3 centroid = Vec3::Zero();
  double radius_m = 0;
  long points = 0;

  explicit Extent(const JointObjective& objective) {
    centroid = SourceCentroid(objective);
    ForEachSourcePoint(objective, [&](const Vec3& p) {
      radius_m += (p - centroid).squaredNorm();
      ++points;
    });
    radius_m = std::sqrt(radius_m / static_cast<double>(points));
    if (radius_m == 0) {
      radius_m = 1;  // Points in one place see no rotation, whatever its lever arm.
    }
  }
};

double LargestEigenvalue(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[symmetric.cols() - 1];
}

// Splits the directions by a symmetric matrix over them: those whose eigenvalue is above the limit
// are kept, the others returned.
Directions TakeOutWeak(const Eigen::MatrixXd& symmetric, double limit, Directions* kept) {
  if (kept->cols() == 0) {
    return *kept;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  const Eigen::VectorXd& values = solver.eigenvalues();
  const Eigen::Index weak =
      std::count_if(values.begin(), values.end(), [&](double value) { return !(value > limit); });
  const Directions all = *kept * solver.eigenvectors();
  *kept = all.rightCols(all.cols() - weak);
  return all.leftCols(weak);
}

void AddUndetermined(const Directions& directions, Cause cause, Verdict* verdict) {
  for (NamedDirection& named : NameDirections(directions)) {
    verdict->undetermined.push_back({std::move(named), cause});
  }
}

// Those main axes of a 3x3 block of the covariance along which the deviation is beyond the
// tolerance (of that block, in m at the lever arm).
void AddBeyondTolerance(const Mat6& covariance, Eigen::Index begin, double tolerance,
                        Verdict* verdict) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance.block<3, 3>(begin, begin));
  Directions beyond(6, 0);
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (solver.eigenvalues()[k] > tolerance * tolerance) {
      beyond.conservativeResize(6, beyond.cols() + 1);
      beyond.rightCols(1).setZero();
      beyond.rightCols(1).middleRows(begin, 3) = solver.eigenvectors().col(k);
    }
  }
  AddUndetermined(beyond, Cause::kBeyondTolerance, verdict);
}

// How many of so few independent sums a covariance of so many unknowns is short of.
double SmallSampleFactor(long rows, long clusters, long unknowns) {
  const auto factor = [](long n, long less) {
    return n > less ? static_cast<double>(n) / static_cast<double>(n - less)
                    : std::numeric_limits<double>::infinity();
  };
  return factor(rows, unknowns) * factor(clusters, 1);
}

bool StopsAsWanted(Termination termination) {
  return termination == Termination::kConverged || termination == Termination::kCostChange ||
         termination == Termination::kCostReached || termination == Termination::kStopped;
}

}  // namespace

Directions Verdict::Unobservable() const {
  Directions all(6, 0);
  for (const UndeterminedDirection& one : undetermined) {
    if (one.cause != Cause::kBeyondTolerance) {
      all.conservativeResize(6, all.cols() + 1);
      all.rightCols(1) = one.direction;
    }
  }
  return all;
}

std::vector<std::string> Verdict::UndeterminedNames() const {
  if (undetermined.empty()) {
    return {};
  }
  Directions all(6, static_cast<Eigen::Index>(undetermined.size()));
  for (std::size_t k = 0; k < undetermined.size(); ++k) {
    all.col(static_cast<Eigen::Index>(k)) = undetermined[k].direction;
  }
  // Directions of two causes need not be orthogonal.
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(all, Eigen::ComputeThinU);
  svd.setThreshold(0.1);
  std::vector<std::string> names;
  for (const NamedDirection& named : NameDirections(svd.matrixU().leftCols(svd.rank()))) {
    names.push_back(named.name);
  }
  return names;
}

SE3d Verdict::WithPrediction(const SE3d& T_found, const SE3d& T_predicted) const {
  const Directions unseen = Unobservable();
  if (unseen.cols() == 0) {
    return T_found;
  }
  const Vec6 z = to_centroid * (T_predicted.Inverse() * T_found).Log();
  const Vec6 seen = z - unseen * (unseen.transpose() * z);
  return (T_predicted * SE3d::Exp(to_centroid.inverse() * seen)).Normalized();
}

std::string Verdict::Text() const {
  if (!HasPose()) {
    return "no pose: " + no_pose;
  }
  const std::vector<std::string> parts = UndeterminedNames();
  std::string text = parts.empty() ? "determined" : "undetermined: " + Join(parts) + ";";
  text += parts.empty() ? ", " : " ";
  text += converged ? "converged" : std::string("not converged (") + NameOf(termination) + ")";
  return text + ", " + Fixed(100 * matched_share, 0) + " % of the points took part";
}

Verdict JudgePose(const JointObjective& objective, const MinimizerSummary& summary,
                  const VerdictOptions& options) {
  Verdict verdict;
  verdict.termination = summary.termination;
  if (!summary.Usable()) {
    verdict.no_pose = summary.message;
    return verdict;
  }
  const SE3d& T = summary.T_target_source();
  const int threads = options.minimizer.threads;
  const ScoreSums sums = SumScores(objective, T, objective.Match(T, threads), options.cluster_m);
  const Extent extent(objective);
  verdict.pairs = sums.pairs;
  verdict.rows = sums.rows;
  verdict.matched_share = static_cast<double>(sums.pairs) / static_cast<double>(extent.points);
  verdict.to_centroid = AboutPoint(extent.centroid, extent.radius_m);
  const Mat6 from_centroid = verdict.to_centroid.inverse();
  const Directions free = FreeDirections(options.minimizer.free, verdict.to_centroid);
  if (sums.rows < free.cols()) {
    verdict.no_pose = std::to_string(sums.rows) + " residual rows for " +
                      std::to_string(free.cols()) +
                      " free directions; expected more rows than directions.";
    return verdict;
  }

  Directions kept = free;
  const auto over_kept = [&](const Mat6& matrix) -> Eigen::MatrixXd {
    const Directions motions = from_centroid * kept;
    return motions.transpose() * matrix * motions;
  };
  // The largest over all six directions: those that are free may all be unseen.
  const double largest_of_H =
      LargestEigenvalue(from_centroid.transpose() * sums.gauss_newton * from_centroid);
  AddUndetermined(TakeOutWeak(over_kept(sums.gauss_newton), kLeastOfH * largest_of_H, &kept),
                  Cause::kNotObserved, &verdict);
  const double step_m = std::min(kLongestStep, kLongestShare * extent.radius_m);
  const Directions observed = kept;
  const Eigen::MatrixXd B =
      RematchedHessian(objective, T, from_centroid * observed * step_m, threads) /
      (step_m * step_m);
  AddUndetermined(TakeOutWeak(0.5 * (B + B.transpose()), kLeastOfB * largest_of_H, &kept),
                  Cause::kNoCurvature, &verdict);

  const Eigen::MatrixXd P = observed.transpose() * kept;
  const Eigen::MatrixXd B_inverse = (P.transpose() * B * P).inverse();
  const bool clustered = sums.clusters > 2 * kept.cols();
  const double factor =
      SmallSampleFactor(sums.rows, clustered ? sums.clusters : sums.pairs, free.cols());
  const Mat6 covariance = kept * B_inverse *
                          (factor * over_kept(clustered ? sums.cluster_scores : sums.scores)) *
                          B_inverse.transpose() * kept.transpose();
  if (covariance.allFinite()) {
    AddBeyondTolerance(covariance, 0, options.tolerance_rad * extent.radius_m, &verdict);
    AddBeyondTolerance(covariance, 3, options.tolerance_m, &verdict);
  } else {  // As many rows as unknowns: nothing is left over to tell a deviation from.
    AddUndetermined(kept, Cause::kBeyondTolerance, &verdict);
  }

  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    double undetermined = 0;
    for (const UndeterminedDirection& one : verdict.undetermined) {
      undetermined += std::pow(one.direction[axis], 2);
    }
    const bool is_free = free.row(axis).squaredNorm() > 1e-9;
    verdict.deviation[axis] =
        undetermined > 0.1 && is_free
            ? std::numeric_limits<double>::quiet_NaN()
            : std::sqrt(std::abs(covariance(axis, axis))) / (axis < 3 ? extent.radius_m : 1.0);
  }

  verdict.converged = StopsAsWanted(summary.termination);
  if (summary.termination == Termination::kLimitCycle) {
    verdict.converged = summary.cycle_m < kHarmlessCycle * options.tolerance_m &&
                        summary.cycle_rad < kHarmlessCycle * options.tolerance_rad;
  }
  if (summary.termination == Termination::kNoDescent && kept.cols() > 0) {
    // A step that would be short anyway is convergence: rounding keeps the cost from falling.
    const Directions motions = from_centroid * kept;
    const Vec6 gradient = objective.Evaluate(T, threads).sums.gradient;
    const Vec6 step =
        kept * over_kept(sums.gauss_newton).ldlt().solve(motions.transpose() * gradient);
    verdict.converged = step.head<3>().norm() < extent.radius_m * options.minimizer.min_step_rad &&
                        step.tail<3>().norm() < options.minimizer.min_step_m;
  }
  return verdict;
}

}  // namespace icpscape
