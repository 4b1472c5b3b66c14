// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_FILTERING_KEPT_POINTS_H_
#define ICPSCAPE_SRC_FILTERING_KEPT_POINTS_H_

#include <vector>

namespace icpscape {

/// Which points a filter keeps of a pair of scans, for PointCloud::Select: one entry per point that
/// came in, 1 is kept. Filters select: a kept point has the coordinates it came with, in its own
/// frame.
struct KeptPoints {
  std::vector<char> source;
  std::vector<char> target;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_FILTERING_KEPT_POINTS_H_
