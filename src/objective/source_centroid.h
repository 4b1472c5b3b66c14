// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_SOURCE_CENTROID_H_
#define ICPSCAPE_SRC_OBJECTIVE_SOURCE_CENTROID_H_

#include "icpscape/objective/joint_objective.h"

namespace icpscape {

/// Calls f(p) for the source's points, term after term: all points that the objective matches.
template <class F>
void ForEachSourcePoint(const JointObjective& objective, const F& f) {
  for (const Objective& term : objective.objectives()) {
    const PointCloud& source = term.matcher().source();
    for (std::size_t i = 0; i < source.size(); ++i) {
      f(source.Point(i));
    }
  }
}

/// The mean of these points, in the frame of the source: steps and distances of poses are those of
/// this point, wherever the origin is. (0, 0, 0) where there is no point.
inline Vec3 SourceCentroid(const JointObjective& objective) {
  Vec3 sum = Vec3::Zero();
  long points = 0;
  ForEachSourcePoint(objective, [&](const Vec3& p) {
    sum += p;
    ++points;
  });
  return points == 0 ? sum : Vec3(sum / static_cast<double>(points));
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_SOURCE_CENTROID_H_
