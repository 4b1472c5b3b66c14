// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_CONSTANT_VELOCITY_H_
#define ICPSCAPE_SRC_CLOUD_CONSTANT_VELOCITY_H_

#include <cmath>

#include "icpscape/residuals/lie.h"

namespace icpscape {

/// Spans of time that differ by less than this share are taken for equal: clocks of scanners and
/// computers jitter, scanners turn evenly.
inline constexpr double kTimeJitter = 0.1;

/// The motion during `span_s` at the constant velocity (body twist) of a motion that took
/// `motion_span_s`: Exp(span / motion_span Log(motion)). The motion itself where the spans are
/// equal up to kTimeJitter, or their ratio is no positive number: the times are not known then.
inline SE3d MotionDuring(double span_s, const SE3d& motion, double motion_span_s) {
  const double ratio = span_s / motion_span_s;
  if (!std::isfinite(ratio) || ratio <= 0 || std::abs(ratio - 1) <= kTimeJitter) {
    return motion;
  }
  return SE3d::Exp(ratio * motion.Log());
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_CONSTANT_VELOCITY_H_
