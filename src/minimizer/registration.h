// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MINIMIZER_REGISTRATION_H_
#define ICPSCAPE_SRC_MINIMIZER_REGISTRATION_H_

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/minimizer/minimizer.h"
#include "icpscape/objective/objective_set.h"

namespace icpscape {

/// How the closed loop is run on a pair of scans.
enum class Preset {
  kPaper,   ///< One loop over the objective as the options have it.
  kRobust,  ///< Several loops: all pairs first, then a gate that shrinks, and Huber's loss.
};
template <>
struct Names<Preset> {
  static constexpr const char* kWhat = "preset";
  static constexpr const char* kNames[] = {"paper", "robust"};
};

/// Neighbours of a normal under kRobust: 20 smooth over corners where scans are thinned.
inline constexpr int kRobustNormalNeighbors = 10;

/// One loop of a registration.
struct Stage {
  std::size_t first_iterate = 0;  ///< Among the iterates of the summary.
  double max_distance_m = 0;      ///< Longest pair; 0 is no limit.
  /// Where Huber's loss bends, one per metric (units of its residual); empty without a loss.
  std::vector<double> loss_scales;
};

/// What a registration found.
struct Registered {
  std::shared_ptr<const ObjectiveSet> set;
  /// Of the last stage: the pose is judged by it. Its matchers belong to `set`.
  JointObjective objective;
  /// Of the last stage, but with the iterates and matching passes of all. Costs of different stages
  /// are sums over different pairs.
  MinimizerSummary summary;
  std::vector<Stage> stages;
};

/// The closed loop on one pair of scans, from any start.
///
/// kRobust begins with every source point and its closest target point, however far, since a gate
/// that is too small for the start hides the way. Then, with s = 1.4826 times the median length of
/// all pairs at the pose that was found, pairs longer than 4 s are left out, and so on while the
/// gate shrinks by a fifth. These loops see 20000 points of the source, spread evenly over it. In
/// the end the scale of Huber's loss is 1.345 times 1.4826 times the median |r| of each metric, and
/// all points take part. Nothing depends on the unit of length.
class Registration {
 public:
  /// Weights as in JointObjective. Throws UsageError as ObjectiveSet and JointObjective do; and
  /// under kRobust, which has its own gate and loss, for a gate, a loss, or a metric of edge or
  /// planar points.
  Registration(PreparedPair scans, std::vector<std::string> metrics, std::vector<double> weights,
               ObjectiveSetOptions options, Preset preset, int threads);

  /// Never throws for trouble with the data: see MinimizerSummary::termination. Safe from several
  /// threads at once. Bit-identical for any number of threads. Throws UsageError for
  /// every_evaluation under kRobust, whose gate makes sums over all pairs incomparable.
  Registered Run(const SE3d& T_start, const MinimizerOptions& options) const;

 private:
  Registered RunPaper(const SE3d& T_start, const MinimizerOptions& options) const;
  Registered RunRobust(const SE3d& T_start, const MinimizerOptions& options) const;

  PreparedPair scans_, thinned_;
  std::vector<std::string> metrics_;
  std::vector<double> weights_;
  ObjectiveSetOptions options_;
  Preset preset_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MINIMIZER_REGISTRATION_H_
