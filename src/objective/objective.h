// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_H_
#define ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_H_

#include <memory>
#include <string>

#include "residuals/normal_equations.h"
#include "src/cloud/point_cloud.h"
#include "src/matching/matcher.h"

namespace ceres {
class LossFunction;
class Problem;
}  // namespace ceres

namespace icpscape {

/// An objective's value and derivatives at one pose.
struct Evaluation {
  /// cost = 1/2 sum rho(|r|^2), gradient, Gauss-Newton Hessian and n: what the solver minimises.
  NormalEquations sums;
  /// sum |r|^2, whatever the loss (m^2).
  double sum_squared = 0;
  /// The paper's eps(T), as printed; it knows no loss.
  double epsilon = 0;
  /// d epsilon / d xi, T <- T Exp([omega; v]).
  Vec6 epsilon_gradient = Vec6::Zero();

  /// Adds weight times the other; n counts whole.
  void Add(const Evaluation& other, double weight);

  long n() const { return sums.num_correspondences; }
  /// RMSE(eps) = sqrt(eps / n) [paper sec. 4]; NaN where n = 0.
  double Rmse() const;
  /// sqrt(sum |r|^2 / n); NaN where n = 0.
  double RmsResidual() const;
  /// d Rmse / du for a motion with body twist xi = dT/du.
  double RmseSlope(const Vec6& body_twist) const;
};

/// The objective function of ICP for one metric and one pair of clouds: the one function behind the
/// solver and every plot.
///
/// It is evaluated either with frozen matches, at any pose, or re-associated, with the matches that
/// belong to the pose. The matcher and its clouds must outlive it. Evaluations are bit-identical
/// for any number of threads, and safe from several threads at once.
class Objective {
 public:
  /// Throws UsageError for an unknown metric (the message lists the known ones). The matcher must
  /// provide what the metric needs, and the clouds the normals (CHECKed). Without a loss, a metric
  /// whose printed form is one (planar_to_patch: SoftLOneLoss(1)) keeps that.
  Objective(const std::string& metric, const Matcher& matcher,
            std::shared_ptr<const ceres::LossFunction> loss = nullptr);

  const std::string& metric() const { return metric_; }
  const Matcher& matcher() const { return *matcher_; }

  Matches Match(const SE3d& T_target_source, int threads) const;

  /// Frozen: the sums over these matches at this pose. Pairs without a valid normal, where the
  /// metric needs one, are left out.
  Evaluation Evaluate(const SE3d& T_target_source, const Matches& matches, int threads) const;

  /// Re-associated: matched at this pose, then summed.
  Evaluation Evaluate(const SE3d& T_target_source, int threads) const;

  /// Adds one CeresCost per pair to the problem, over the seven parameters x, under the loss (null
  /// for none), which the problem must not own. The way round SquareRootCost where a loss has
  /// rho'' > 0, and the second opinion in the tests.
  void AddResidualBlocks(const Matches& matches, const ceres::LossFunction* loss, double* x,
                         ceres::Problem* problem) const;

  /// Whether the loss has rho'' > 0 somewhere (found by sampling s from 1e-12 to 1e12 m^2).
  bool HasUpwardLoss() const;

  /// Null for none.
  const ceres::LossFunction* loss() const { return loss_.get(); }

 private:
  struct MetricFunctions;
  std::string metric_;
  const Matcher* matcher_;
  std::shared_ptr<const ceres::LossFunction> loss_;
  const MetricFunctions* functions_;
};

/// Throws UsageError unless the metric is registered.
void CheckMetricName(const std::string& metric);

/// Union of Needs of a registered metric.
unsigned MetricNeeds(const std::string& metric);

/// What the paper sums for a registered metric.
Epsilon MetricEpsilon(const std::string& metric);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_H_
