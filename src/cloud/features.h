// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_FEATURES_H_
#define ICPSCAPE_SRC_CLOUD_FEATURES_H_

#include <cstddef>
#include <vector>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/cloud/smoothness.h"

namespace icpscape {

/// Limits the number of features. Each ring is cut into regions with equally many points. In each
/// region the largest s_i become edges, then the smallest become planar; ties go by the order of
/// the ring. A point within ring_points_per_side points of a feature is skipped [LOAM sec. V-A].
struct FeatureCaps {
  int regions_per_ring = 0;  ///< 0 switches the caps off, as in the paper.
  int edges_per_region = 0;
  int planar_per_region = 0;
};

/// LOAM: four subregions of a scan, two edge and four planar points each [Zhang & Singh 2014].
inline constexpr FeatureCaps kLoamCaps{4, 2, 4};
/// A-LOAM's sharp and flat points: six subregions, two and four points.
inline constexpr FeatureCaps kALoamSharpCaps{6, 2, 4};
/// A-LOAM's less sharp points: 20 to a subregion, the sharp ones included.
inline constexpr FeatureCaps kALoamLessSharpCaps{6, 20, 4};

struct FeatureOptions {
  SmoothnessOptions smoothness;
  /// Planar where s_i is below this: 0.1 in the paper (printed formula, no unit), and 0.1 m^2 in
  /// A-LOAM and LIO-SAM.
  double planar_below = 0.1;
  /// Edge where s_i is this or above. The paper's "all other points": the same 0.1. A-LOAM too;
  /// LIO-SAM takes 1 m^2.
  double edge_from = 0.1;
  FeatureCaps caps;
};

/// The thresholds of the convention that the formula belongs to; no caps.
FeatureOptions ConventionalFeatureOptions(SmoothnessFormula formula);

/// One entry per point of the cloud, for PointCloud::Select. No point is both edge and planar.
struct Features {
  std::vector<char> edge;
  std::vector<char> planar;
  std::size_t num_edge = 0;
  std::size_t num_planar = 0;

  /// The entries of the points i with keep[i] != 0, in order; empty where these are empty.
  Features Select(const std::vector<char>& keep) const;
};

/// Edge and planar points [paper sec. 2.4 and 4.2]. A point whose s_i is NaN is neither edge nor
/// planar. Logs a warning for a class of fewer than 500 points: without caps, the threshold then
/// hardly fits the neighbourhood (printed formula on KITTI 00/15: 7.7 % of the points are edges
/// with ring windows, 24 points with ten nearest neighbours, 12 points with a radius of 0.5 m).
///
/// The result does not depend on `threads`. Throws UsageError for options out of range, InputError
/// where rings are needed and the cloud has none (see RecoverRings).
Features ExtractFeatures(const PointCloud& cloud, const FeatureOptions& options, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_FEATURES_H_
