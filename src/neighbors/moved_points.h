// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_NEIGHBORS_MOVED_POINTS_H_
#define ICPSCAPE_SRC_NEIGHBORS_MOVED_POINTS_H_

#include <vector>

#include "icpscape/neighbors/points_view.h"
#include "icpscape/residuals/lie.h"

namespace icpscape {

/// Points that moved to another frame, as a search takes its queries.
class MovedPoints {
 public:
  /// T p for every point, in double and rounded to float once: bit for bit
  /// (T * p.cast<double>()).cast<float>(). Allocates only where there are more than ever before.
  void Move(const SE3d& T, const PointsView& points);

  PointsView View() const { return {x_.data(), y_.data(), z_.data(), size_}; }

 private:
  std::vector<float> x_, y_, z_;
  std::size_t size_ = 0;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_NEIGHBORS_MOVED_POINTS_H_
