// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_SMOOTHNESS_H_
#define ICPSCAPE_SRC_CLOUD_SMOOTHNESS_H_

#include <vector>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/common/names.h"

namespace icpscape {

/// Which points surround a point p_i; p_i itself never belongs to its set S_i.
enum class SmoothnessNeighborhood {
  kRing,      ///< The points before and after it on its scan ring [LOAM; A-LOAM].
  kKNearest,  ///< The k nearest other points of the cloud.
  kRadius,    ///< All other points within a radius.
};
template <>
struct Names<SmoothnessNeighborhood> {
  static constexpr const char* kWhat = "smoothness neighbourhood";
  static constexpr const char* kNames[] = {"ring", "k_nearest", "radius"};
};

/// How the surrounding points become one number s_i; small on planes, large on edges. |p| is the
/// range, the distance from PointCloud::sensor.
enum class SmoothnessFormula {
  /// s_i = |sum_j (p_i - p_j)| / (card(S_i) |p_i|), no unit [paper sec. 2.4; Zhang & Singh 2014].
  kPrinted,
  /// s_i = |sum_j (p_i - p_j)|^2, m^2: as A-LOAM computes it. Grows with the squared range.
  kALoam,
  /// s_i = (sum_j (|p_i| - |p_j|))^2, m^2: range differences, as LIO-SAM computes it.
  kLioSam,
};
template <>
struct Names<SmoothnessFormula> {
  static constexpr const char* kWhat = "smoothness";
  static constexpr const char* kNames[] = {"printed", "a_loam", "lio_sam"};
};

struct SmoothnessOptions {
  SmoothnessNeighborhood neighborhood = SmoothnessNeighborhood::kRing;
  SmoothnessFormula formula = SmoothnessFormula::kPrinted;
  /// kRing: points to either side. 5 is what LOAM's followers take; the paper names no number.
  int ring_points_per_side = 5;
  /// kKNearest: other points.
  int num_neighbors = 10;
  /// kRadius.
  double radius_m = 0.5;
};

/// The smoothness s_i of every point. NaN, hence neither edge nor plane, where S_i is incomplete:
/// the first and last ring_points_per_side points of a ring, fewer than num_neighbors other points,
/// none within the radius, or a point at the sensor itself.
///
/// Ring windows do not wrap around: a ring's first and last points lie next to each other, but are
/// the start and the end of a revolution, and no even spacing joins them. (On KITTI 00/15, whose
/// seam is 9 degrees wide, wrapping makes 23 % of the 640 points at the seam edges by the printed
/// rule, against 7.7 % of the others.) Points of a ring are taken in the order of the cloud;
/// dropped returns leave no gap in it.
///
/// Sums are taken in double in the order of the set (ring order, or nearest first), so that the
/// result does not depend on `threads`. Throws UsageError for options out of range, InputError
/// where kRing finds no rings (see RecoverRings).
std::vector<double> ComputeSmoothness(const PointCloud& cloud, const SmoothnessOptions& options,
                                      int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_SMOOTHNESS_H_
