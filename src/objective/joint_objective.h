// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_JOINT_OBJECTIVE_H_
#define ICPSCAPE_SRC_OBJECTIVE_JOINT_OBJECTIVE_H_

#include <memory>
#include <string>
#include <vector>

#include "src/objective/objective.h"

namespace icpscape {

/// A weighted sum of objectives that are minimised together, as LOAM does with its edge and planar
/// distances [paper sec. 2.4]: cost = sum_k w_k cost_k. One objective of weight 1 is itself.
class JointObjective {
 public:
  struct Term {
    const Objective* objective;  ///< Must outlive the sum.
    double weight = 1;
  };

  /// Not explicit: an objective is a joint objective of one term.
  JointObjective(const Objective& objective)  // NOLINT(google-explicit-constructor)
      : JointObjective(std::vector<Term>{{&objective, 1.0}}) {}
  /// Throws UsageError unless all weights are positive.
  explicit JointObjective(std::vector<Term> terms);
  ~JointObjective();
  JointObjective(JointObjective&&) noexcept;
  JointObjective& operator=(JointObjective&&) noexcept;

  /// "edge_to_line + planar_to_plane".
  std::string Name() const;

  /// One entry per term; terms that share a matcher share its work.
  std::vector<Matches> Match(const SE3d& T_target_source, int threads) const;

  Evaluation Evaluate(const SE3d& T_target_source, const std::vector<Matches>& matches,
                      int threads) const;
  Evaluation Evaluate(const SE3d& T_target_source, int threads) const {
    return Evaluate(T_target_source, Match(T_target_source, threads), threads);
  }

  /// Whether one of the losses has rho'' > 0 somewhere.
  bool HasUpwardLoss() const;

  /// As Objective::AddResidualBlocks; the losses belong to this object.
  void AddResidualBlocks(const std::vector<Matches>& matches, double* x,
                         ceres::Problem* problem) const;

 private:
  std::vector<Term> terms_;
  std::vector<std::unique_ptr<ceres::LossFunction>> scaled_losses_;  // One per term.
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_JOINT_OBJECTIVE_H_
