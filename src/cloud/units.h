// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_UNITS_H_
#define ICPSCAPE_SRC_CLOUD_UNITS_H_

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// How large a cloud is, and how dense: what its units show in.
struct CloudScale {
  double range_m = 0;    ///< Median distance of the points from the median along each axis.
  double spacing_m = 0;  ///< Median distance of a point to the next one.

  /// Half of the points beyond 2 km, and points more than 2 m apart: no lidar sees that, but one
  /// whose file has millimetres.
  bool LooksLikeMillimetres() const;
  /// Whether both numbers are a thousandfold (300 to 3000 times) those of the other.
  bool IsThousandfold(const CloudScale& other) const;
};

/// From at most 1000 points of the cloud, and their distances to all.
CloudScale ScaleOf(const PointCloud& cloud);

/// From the same points, without the search that the spacing costs: 0 stands for it.
CloudScale RangeOf(const PointCloud& cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_UNITS_H_
