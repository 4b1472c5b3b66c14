// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_USABLE_POINT_H_
#define ICPSCAPE_SRC_CLOUD_USABLE_POINT_H_

#include <cmath>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Beyond every place on Earth in any coordinates, and far below where squared distances overflow.
inline constexpr double kLargestCoordinateM = 1e9;

/// Whether a registration can use a point with these coordinates; counts it where not.
inline bool IsUsable(double x, double y, double z, DroppedPoints* dropped) {
  const auto is_good = [](double c) { return std::abs(c) <= kLargestCoordinateM; };  // Not NaN.
  const auto is_zero = [](double c) { return static_cast<float>(c) == 0; };
  if (!is_good(x) || !is_good(y) || !is_good(z)) {
    ++dropped->non_finite;
    return false;
  }
  if (is_zero(x) && is_zero(y) && is_zero(z)) {
    ++dropped->zero;
    return false;
  }
  return true;
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_USABLE_POINT_H_
