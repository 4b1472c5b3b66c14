// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/preparation.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>

#include "apps/flags/objective.h"
#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Preparation of a scan");

DEFINE_double(elevation_correction_deg, 0,
              "Turns all points up by this angle (degrees); 0.205 is in use for KITTI's HDL-64.");
static const icpscape::FlagMark elevation_correction_deg_mark(&FLAGS_elevation_correction_deg,
                                                              icpscape::kNotOfDraws);
DEFINE_double(voxel_m, 0,
              "If positive: thins each scan to the centroids of voxels of this size (m), before "
              "normals and filters; not with metrics of edge and planar points.");
static const icpscape::FlagMark voxel_m_mark(&FLAGS_voxel_m, icpscape::kNotOfDraws);
DEFINE_int32(normal_neighbors, 20, "Neighbours of a normal, the point itself included.");
DEFINE_double(normal_radius_m, 0,
              "If positive: the neighbours are all points within this radius (m).");

namespace icpscape {

PreparationOptions PreparationFromFlags(const std::vector<std::string>& metrics) {
  RequireFlag(FLAGS_normal_neighbors >= 3 && FLAGS_normal_neighbors <= 1000, "normal_neighbors",
              std::to_string(FLAGS_normal_neighbors), "at least 3, at most 1000");
  RequireFlag(FLAGS_normal_radius_m >= 0 && std::isfinite(FLAGS_normal_radius_m), "normal_radius_m",
              Number(FLAGS_normal_radius_m), "a length in metres, or 0");
  RequireFlag(std::abs(FLAGS_elevation_correction_deg) <= 5, "elevation_correction_deg",
              Number(FLAGS_elevation_correction_deg), "an angle within 5 degrees");
  RequireFlag(FLAGS_voxel_m >= 0 && std::isfinite(FLAGS_voxel_m), "voxel_m", Number(FLAGS_voxel_m),
              "a length in m, or 0");
  const auto of_features = std::find_if(metrics.begin(), metrics.end(), NeedsFeatures);
  RequireFlag(FLAGS_voxel_m == 0 || of_features == metrics.end(), "voxel_m", Number(FLAGS_voxel_m),
              "0 with " + (of_features == metrics.end() ? "" : *of_features) +
                  ", whose edge and planar points are those of whole scan lines");
  PreparationOptions options;
  options.elevation_correction_deg = FLAGS_elevation_correction_deg;
  options.voxel_m = FLAGS_voxel_m;
  options.normals.num_neighbors = FLAGS_normal_neighbors;
  options.normals.radius_m = FLAGS_normal_radius_m;
  options.features = FeaturesFromFlags();
  return options;
}

}  // namespace icpscape
