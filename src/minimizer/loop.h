// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MINIMIZER_LOOP_H_
#define ICPSCAPE_SRC_MINIMIZER_LOOP_H_

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "icpscape/cloud/displacement.h"
#include "icpscape/minimizer/minimizer.h"
#include "icpscape/objective/source_centroid.h"

namespace icpscape::internal {

/// The bookkeeping of Minimize that both ways to re-associate share: evaluates, records iterates,
/// and knows when and how to end.
class Loop {
 public:
  /// Both must outlive the loop.
  Loop(const JointObjective& objective, const MinimizerOptions& options)
      : objective_(objective), options_(options), centroid_(SourceCentroid(objective)) {}

  const MinimizerOptions& options() const { return options_; }
  /// Whether someone wants to see the matches.
  bool Observed() const { return options_.observer != nullptr; }

  /// Where `keep` is given, the matches go there.
  Evaluation Reassociated(const SE3d& T, MatchesByMatcher* keep = nullptr);
  /// The cost over frozen matches, and nothing else.
  NormalEquations FrozenCost(const SE3d& T, const MatchesByMatcher& matches) const;

  void Record(const SE3d& T, const Evaluation& evaluation, const MatchesByMatcher& matches);
  std::vector<Iterate>* iterates() { return &summary_.iterates; }

  /// Whether the last recorded iterate ends the loop, whatever the next step would be.
  bool Ended() const { return end_.has_value(); }
  /// Whether the step from the last recorded pose to this one is short enough to end the loop.
  bool IsShortStepTo(const SE3d& T) const;
  bool LastStepWasShort() const;

  /// After how many steps the last two poses were there before; 0 where they were not.
  std::size_t Period() const;

  MinimizerSummary End(Termination termination, std::string message);
  MinimizerSummary EndHere() { return End(end_->first, end_->second); }
  /// A step that is short because longer ones were rejected before it is no convergence.
  MinimizerSummary EndShortStep(int rejected);
  MinimizerSummary EndNoCorrespondences();
  MinimizerSummary EndFlat();
  MinimizerSummary EndLimitCycle(std::size_t period);
  MinimizerSummary EndMaxIterations();
  MinimizerSummary EndNoDescent();
  /// Where Ceres gave up. At a perfect fit it finds its steps, of length 0, invalid: no failure.
  MinimizerSummary EndSolverFailure(std::string message);

 private:
  using Clock = std::chrono::steady_clock;

  void FindEnd(const Evaluation& evaluation, const MatchesByMatcher& matches);
  bool IsShort(double step_m, double step_rad) const;
  /// Of the source's centroid.
  Displacement Between(const SE3d& from, const SE3d& to) const;

  const JointObjective& objective_;
  const MinimizerOptions& options_;
  Vec3 centroid_;  // Of the source.
  MinimizerSummary summary_;
  std::optional<std::pair<Termination, std::string>> end_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace icpscape::internal

#endif  // ICPSCAPE_SRC_MINIMIZER_LOOP_H_
