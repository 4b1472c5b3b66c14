// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_H_
#define ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_H_

#include <memory>
#include <string>

#include "icpscape/matching/matcher.h"
#include "icpscape/objective/evaluation.h"
#include "icpscape/objective/pair_block.h"
#include "icpscape/objective/registered_metric.h"

namespace ceres {
class LossFunction;
class Problem;
}  // namespace ceres

namespace icpscape {

/// The objective function of ICP for one metric and one pair of clouds: the one function behind the
/// solver and every plot.
///
/// It is evaluated either with frozen matches, at any pose, or re-associated, with the matches that
/// belong to the pose. The matcher and its clouds must outlive it. Evaluations are bit-identical
/// for any number of threads, and safe from several threads at once.
class Objective {
 public:
  /// Throws UsageError where the matcher or the clouds lack what the metric needs. Without
  /// a loss, a metric whose printed form is one (planar_to_patch: SoftLOneLoss(1)) keeps that. Runs
  /// at the SIMD level that is active now.
  Objective(const RegisteredMetric& metric, const Matcher& matcher,
            std::shared_ptr<const ceres::LossFunction> loss = nullptr);
  /// By name. Throws UsageError for an unknown metric (the message lists the known ones).
  Objective(const std::string& metric, const Matcher& matcher,
            std::shared_ptr<const ceres::LossFunction> loss = nullptr);
  /// The matcher would die at once.
  Objective(const RegisteredMetric& metric, const Matcher&& matcher,
            std::shared_ptr<const ceres::LossFunction> loss = nullptr) = delete;
  Objective(const std::string& metric, const Matcher&& matcher,
            std::shared_ptr<const ceres::LossFunction> loss = nullptr) = delete;

  const RegisteredMetric& metric() const { return *metric_; }
  const Matcher& matcher() const { return *matcher_; }
  /// What the metric needs of a pair.
  unsigned needs() const { return metric_->needs; }

  Matches Match(const SE3d& T_target_source, int threads) const;

  /// Frozen: the sums over these matches at this pose. Pairs without a valid normal, where the
  /// metric needs one, are left out. Throws UsageError for matches of another source.
  Evaluation Evaluate(const SE3d& T_target_source, const Matches& matches, int threads) const;

  /// Re-associated: matched at this pose and summed. See pass.h for several objectives at once.
  Evaluation Evaluate(const SE3d& T_target_source, int threads) const;

  /// Adds the sums over a block of pairs; those that lack what the metric needs are left out.
  void Add(const PairBlock& block, const SE3d& T_target_source, Derivatives derivatives,
           Evaluation* sums) const;

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
  const RegisteredMetric* metric_;
  const Matcher* matcher_;
  std::shared_ptr<const ceres::LossFunction> loss_;
  BlockKernel kernel_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_H_
