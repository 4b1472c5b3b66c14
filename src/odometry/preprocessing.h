// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_PREPROCESSING_H_
#define ICPSCAPE_SRC_ODOMETRY_PREPROCESSING_H_

#include <memory>

#include "src/cloud/features.h"
#include "src/cloud/normals.h"
#include "src/cloud/point_cloud.h"
#include "src/objective/objective_set.h"

namespace icpscape {

/// What is done to every scan before it is registered, in this order.
struct PreprocessingOptions {
  double elevation_correction_deg = 0;  ///< See CorrectElevation.
  double voxel_m = 0;                   ///< If positive: the centroids of voxels of this size.
  NeighborhoodOptions normals;
  FeatureOptions features;
};

/// What a registration takes of a scan: a union of Needs, those of its metrics and rejections.
/// Features are extracted where edges or planar points are among them.
struct PreparedScan {
  PointCloud cloud;  ///< With normals where they are needed.
  Features features;
  PointCloud edges, planar;
  MetricClouds clouds;  ///< Over the three above; all points always.

  PreparedScan() = default;
  PreparedScan(const PreparedScan&) = delete;  // The clouds refer to this object.
  PreparedScan& operator=(const PreparedScan&) = delete;
};

/// Throws InputError where rings are needed and cannot be recovered.
std::unique_ptr<const PreparedScan> Prepare(PointCloud scan, unsigned needs,
                                            const PreprocessingOptions& options, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_PREPROCESSING_H_
