// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_FILTERING_FILTER_STATISTICS_H_
#define ICPSCAPE_SRC_FILTERING_FILTER_STATISTICS_H_

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// Of `points` points, a filter kept `kept`; NaN where there were none.
struct KeptCount {
  std::size_t points = 0;
  std::size_t kept = 0;

  double Fraction() const;
};

/// The points with from_m <= |p| < to_m.
struct RangeBin {
  double from_m = 0;
  double to_m = 0;
  KeptCount count;
};

/// Over all points. `keep` has one entry per point, as in KeptPoints.
KeptCount CountKept(const std::vector<char>& keep);

/// By the distance from the sensor, in bins of bin_m from 0 to beyond the furthest point: scans are
/// sparse far out, where filters that compare them by cells drop static points as well.
std::vector<RangeBin> KeptByRange(const PointCloud& cloud, const std::vector<char>& keep,
                                  double bin_m);

/// How well a filter found the dynamic points of a labelled scan.
struct RemovalScore {
  std::size_t removed = 0;
  std::size_t dynamic = 0;
  std::size_t dynamic_removed = 0;

  /// Of the removed points, the share that is dynamic; NaN where none was removed.
  double Precision() const;
  /// Of the dynamic points, the share that was removed; NaN where there is none.
  double Recall() const;
};

/// Throws InputError where the cloud has no labels.
RemovalScore ScoreRemoval(const PointCloud& cloud, const std::vector<char>& keep,
                          const std::function<bool(std::int32_t label)>& is_dynamic);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_FILTERING_FILTER_STATISTICS_H_
