// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PREPARATION_PREPARED_SCAN_H_
#define ICPSCAPE_SRC_PREPARATION_PREPARED_SCAN_H_

#include <optional>
#include <vector>

#include "icpscape/cloud/features.h"
#include "icpscape/cloud/normals.h"
#include "icpscape/matching/metric_clouds.h"

namespace icpscape {

/// What is done to every scan before it is registered, in this order.
struct PreparationOptions {
  double elevation_correction_deg = 0;  ///< See CorrectElevation.
  double voxel_m = 0;                   ///< If positive: the centroids of voxels of this size.
  NeighborhoodOptions normals;
  FeatureOptions features;
};

/// A scan as registration takes it. Copies are cheap: they share clouds and searches, so that each
/// search is built once (see SearchableCloud).
class PreparedScan {
 public:
  /// A cloud whose normals are there, with the features where metrics of lines or patches need
  /// them.
  explicit PreparedScan(SearchableCloud points, std::optional<Features> features = std::nullopt);

  const PointCloud& cloud() const { return clouds_.points->cloud(); }
  const std::optional<Features>& features() const { return features_; }
  /// All points; and where there are features, the edge and the planar points.
  const MetricClouds& clouds() const { return clouds_; }
  /// As the target of any metric: lines and patches are fitted to all points.
  MetricClouds AsTarget() const { return {clouds_.points, clouds_.points, clouds_.points}; }

  /// The points i with keep[i] != 0. Normals and features stay with their points: a scan with holes
  /// has other neighbours. `threads` shorten the building of searches.
  PreparedScan Select(const std::vector<char>& keep, int threads) const;

 private:
  std::optional<Features> features_;
  MetricClouds clouds_;
};

/// Prepares a scan for metrics and rejections whose needs are `needs`, a union of Needs: normals
/// where a normal is among them, features where a line or a patch is. Before the points are thinned
/// they are de-skewed by the lidar's `velocity`, unless it is zero (see Deskew). Normals and
/// matching share one search. The result does not depend on `threads`. Throws InputError where
/// rings are needed and cannot be recovered.
PreparedScan Prepare(PointCloud scan, unsigned needs, const PreparationOptions& options,
                     int threads, const Vec6& velocity = Vec6::Zero());

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PREPARATION_PREPARED_SCAN_H_
