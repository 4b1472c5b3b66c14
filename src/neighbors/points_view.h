// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_NEIGHBORS_POINTS_VIEW_H_
#define ICPSCAPE_SRC_NEIGHBORS_POINTS_VIEW_H_

#include <cstddef>

namespace icpscape {

/// Arrays that are read in whole vectors have this many elements behind their last one.
constexpr std::size_t kPadding = 16;

/// Three arrays of equal length; the caller keeps them alive.
struct PointsView {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t size = 0;

  /// The points [begin, end).
  PointsView Slice(std::size_t begin, std::size_t end) const {
    return {x + begin, y + begin, z + begin, end - begin};
  }
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_NEIGHBORS_POINTS_VIEW_H_
