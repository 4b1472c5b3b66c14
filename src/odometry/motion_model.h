// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_MOTION_MODEL_H_
#define ICPSCAPE_SRC_ODOMETRY_MOTION_MODEL_H_

#include <limits>
#include <optional>
#include <string>

#include "icpscape/cloud/constant_velocity.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {

/// Constant velocity from scan to scan: the motion since the last scan is the motion before it,
/// scaled by the time that each took (see MotionDuring). Where one of the times is not known, both
/// are taken to be equal.
class MotionModel {
 public:
  /// The motion from the last scan to one at this time; the identity before there were two.
  SE3d Predict(std::optional<double> time_s) const {
    return MotionDuring(Since(time_s), motion_, span_s_);
  }

  /// The last motion, and the seconds that it took; NaN where they are not known.
  const SE3d& motion() const { return motion_; }
  double span_s() const { return span_s_; }

  /// Seconds since the last scan; NaN where they are not known.
  double Since(std::optional<double> time_s) const {
    return time_s && time_s_ ? *time_s - *time_s_ : std::numeric_limits<double>::quiet_NaN();
  }

  /// Throws UsageError unless the time, where it is known, comes after the last one.
  void Check(std::optional<double> time_s) const {
    if (time_s && time_s_ && !(*time_s > *time_s_)) {
      throw UsageError("a scan at " + Number(*time_s) + " s after one at " + Number(*time_s_) +
                       " s; expected increasing times.");
    }
  }

  /// The next scan, and the motion since the last one: the identity for the first.
  void Add(const SE3d& motion, std::optional<double> time_s) {
    motion_ = motion;
    span_s_ = Since(time_s);
    time_s_ = time_s;
  }

 private:
  SE3d motion_;
  double span_s_ = std::numeric_limits<double>::quiet_NaN();  // Of motion_.
  std::optional<double> time_s_;                              // Of the last scan.
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_MOTION_MODEL_H_
