// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_
#define ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_

#include "residuals/lie.h"

namespace icpscape {

/// What a metric needs of a pair besides the two points; a metric's kNeeds is a union of these.
enum Needs : unsigned {
  kPointsOnly = 0,
  kSourceNormal = 1U << 0,
  kTargetNormal = 1U << 1,
};

/// All that a matcher can provide about one pair. Built on the fly from the clouds, never stored in
/// arrays; what a metric does not need may be left unset.
struct Correspondence {
  Vec3 p_source;  ///< Point, source frame (m).
  Vec3 q_target;  ///< Its match, target frame (m).
  Vec3 n_source;  ///< Unit normal at p_source, source frame (kSourceNormal).
  Vec3 n_target;  ///< Unit normal at q_target, target frame (kTargetNormal).
};

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_
