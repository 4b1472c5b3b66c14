// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_SET_H_
#define ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_SET_H_

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "src/cloud/features.h"
#include "src/matching/matcher_kinds.h"
#include "src/objective/objective.h"

namespace icpscape {

/// Whether a metric works on edge or planar points, which must be extracted first.
bool NeedsFeatures(const std::string& metric);

/// How the objectives of several metrics are set up over one pair of scans.
struct ObjectiveSetOptions : MatcherOptions {
  std::shared_ptr<const ceres::LossFunction> loss;
  int threads = 1;  ///< To build the searches; results do not depend on it.
};

/// The objectives of several metrics over one pair of scans, with the matchers that they need; see
/// AllMatcherKinds. Metrics of a kind share a matcher.
class ObjectiveSet {
 public:
  /// The clouds must outlive the set, and have normals where a metric needs them; `features` are
  /// the source's, and may be empty where no metric needs them. Throws UsageError for unknown
  /// metrics, ComputationError where a metric has no source point.
  ObjectiveSet(const PointCloud& source, const PointCloud& target, const Features& features,
               const std::vector<std::string>& metrics, const ObjectiveSetOptions& options);

  /// The same over clouds that are searchable already, each kind of metric with its own: LOAM keeps
  /// maps of edges and of planar points apart. A metric whose clouds are missing is CHECKed.
  ObjectiveSet(const MetricClouds& source, const MetricClouds& target,
               const std::vector<std::string>& metrics, const ObjectiveSetOptions& options);

  const std::vector<Objective>& objectives() const { return objectives_; }

 private:
  void AddObjectives(const MetricClouds& source, const MetricClouds& target,
                     const std::vector<std::string>& metrics, const ObjectiveSetOptions& options);
  const Matcher& MatcherFor(const RegisteredMetric& metric, const MetricClouds& source,
                            const MetricClouds& target, const ObjectiveSetOptions& options);

  // On the heap: the matchers refer to them, and a set may be moved.
  std::unique_ptr<PointCloud> edges_;
  std::unique_ptr<PointCloud> planar_;
  std::map<const MatcherKind*, std::unique_ptr<Matcher>> matchers_;
  std::vector<Objective> objectives_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_OBJECTIVE_SET_H_
