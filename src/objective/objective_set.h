// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_SET_H_
#define ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_SET_H_

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "icpscape/matching/matcher_kinds.h"
#include "icpscape/objective/objective.h"
#include "icpscape/preparation/prepared_pair.h"

namespace icpscape {

/// Whether a metric works on edge or planar points, which must be extracted first.
bool NeedsFeatures(const std::string& metric);

/// How the objectives of several metrics are set up over one pair of scans.
struct ObjectiveSetOptions : MatcherOptions {
  std::shared_ptr<const ceres::LossFunction> loss;
};

/// What the metrics and the rejections of a registration need of its scans: a union of Needs.
unsigned NeedsOf(const std::vector<std::string>& metrics, const MatchingOptions& matching);

/// The objectives of several metrics over one pair of scans, with the matchers that they need; see
/// AllMatcherKinds. Metrics of a kind share a matcher, and all matchers the searches of the scans.
class ObjectiveSet {
 public:
  /// Scan to scan: lines and patches are fitted to all points of the target. The scans must have
  /// what the metrics need. Throws UsageError for unknown metrics, ComputationError where a metric
  /// has no source point.
  ObjectiveSet(const PreparedPair& scans, const std::vector<std::string>& metrics,
               const ObjectiveSetOptions& options);

  /// The same with clouds for each kind of metric: LOAM keeps maps of edges and of planar points
  /// apart. Throws UsageError where a metric's clouds are missing.
  ObjectiveSet(const MetricClouds& source, const MetricClouds& target,
               const std::vector<std::string>& metrics, const ObjectiveSetOptions& options);

  /// Their matchers live as long as the set does.
  const std::vector<Objective>& objectives() const& { return objectives_; }
  const std::vector<Objective>& objectives() && = delete;

 private:
  const Matcher& MatcherFor(const RegisteredMetric& metric, const MetricClouds& source,
                            const MetricClouds& target, const ObjectiveSetOptions& options);

  // On the heap: the objectives refer to them, and a set may be moved.
  std::map<const MatcherKind*, std::unique_ptr<Matcher>> matchers_;
  std::vector<Objective> objectives_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_SET_H_
