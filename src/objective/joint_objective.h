// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_JOINT_OBJECTIVE_H_
#define ICPSCAPE_SRC_OBJECTIVE_JOINT_OBJECTIVE_H_

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "icpscape/objective/pass.h"

namespace icpscape {

/// A weighted sum of objectives that are minimised together, as LOAM does with its edge and planar
/// distances [paper sec. 2.4]: cost = sum_k w_k cost_k. One objective of weight 1 is itself.
class JointObjective {
 public:
  /// Not explicit: an objective is a joint objective of one term.
  JointObjective(Objective objective)  // NOLINT(google-explicit-constructor)
      : JointObjective(std::vector<Objective>{std::move(objective)}, {}) {}
  /// One positive weight for each objective, or none: then each is 1. The objectives' matchers must
  /// outlive the sum. Throws UsageError.
  JointObjective(std::vector<Objective> objectives, std::vector<double> weights);
  ~JointObjective();
  JointObjective(JointObjective&&) noexcept;
  JointObjective& operator=(JointObjective&&) noexcept;

  const std::vector<Objective>& objectives() const { return objectives_; }
  /// One per objective.
  const std::vector<double>& weights() const { return weights_; }

  /// "edge_to_line + planar_to_plane".
  std::string Name() const;

  /// Terms that share a matcher share its work.
  MatchesByMatcher Match(const SE3d& T_target_source, int threads) const;

  Evaluation Evaluate(const SE3d& T_target_source, const MatchesByMatcher& matches, int threads,
                      Derivatives derivatives = Derivatives::kHessian) const;
  /// Re-associated; the matches go to `keep` if it is given.
  Evaluation Evaluate(const SE3d& T_target_source, int threads,
                      MatchesByMatcher* keep = nullptr) const;

  /// Whether one of the losses has rho'' > 0 somewhere.
  bool HasUpwardLoss() const;

  /// As Objective::AddResidualBlocks; the losses belong to this object.
  void AddResidualBlocks(const MatchesByMatcher& matches, double* x, ceres::Problem* problem) const;

 private:
  Evaluation WeightedSum(const std::vector<Evaluation>& evaluations) const;

  // One of each per objective.
  std::vector<Objective> objectives_;
  std::vector<double> weights_;
  std::vector<const Objective*> pointers_;
  std::vector<std::unique_ptr<ceres::LossFunction>> scaled_losses_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_JOINT_OBJECTIVE_H_
