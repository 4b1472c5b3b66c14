// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_PASS_H_
#define ICPSCAPE_SRC_OBJECTIVE_PASS_H_

#include <map>
#include <vector>

#include "icpscape/objective/objective.h"

namespace icpscape {

using MatchesByMatcher = std::map<const Matcher*, Matches>;

/// Matches all objectives' source points at the pose; objectives that share a matcher share its
/// matches.
MatchesByMatcher MatchAll(const std::vector<const Objective*>& objectives,
                          const SE3d& T_target_source, int threads);

/// The one pass over the points of a pose that is behind every evaluation. Part by part, source
/// points are moved and matched, and every objective is summed over the pairs while they are in the
/// cache; where a rejection needs to see all pairs first, matching comes before. Parts are of a
/// fixed size and added in order: the same bits for any number of threads.
/// Re-associates, unless there are `frozen` matches; where `keep` is given, the matches go there.
/// Throws UsageError where `frozen` lacks a matcher, or has matches of another source.
std::vector<Evaluation> EvaluateAll(const std::vector<const Objective*>& objectives,
                                    const SE3d& T_target_source, Derivatives derivatives,
                                    int threads, MatchesByMatcher* keep = nullptr);
std::vector<Evaluation> EvaluateAll(const std::vector<const Objective*>& objectives,
                                    const SE3d& T_target_source, const MatchesByMatcher& frozen,
                                    Derivatives derivatives, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_PASS_H_
