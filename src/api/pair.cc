// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/api/pair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

void Require(bool good, const std::string& name, double value, const std::string& expected) {
  if (!good) {
    throw UsageError(name + " is " + Number(value) + "; expected " + expected + ".");
  }
}

bool IsLengthOr0(double value) { return value >= 0 && std::isfinite(value); }

void CheckMetrics(const std::vector<std::string>& metrics) {
  if (metrics.empty()) {
    throw UsageError("No metric is named; expected at least one.");
  }
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    MetricNamed(metrics[i]);  // Throws for an unknown one.
    if (std::find(metrics.begin(), metrics.begin() + static_cast<std::ptrdiff_t>(i), metrics[i]) !=
        metrics.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw UsageError(metrics[i] + " is named twice; expected each metric once.");
    }
  }
}

void CheckPreparation(const PreparationOptions& options, const std::vector<std::string>& metrics) {
  Require(std::isfinite(options.elevation_correction_deg), "elevation_correction_deg",
          options.elevation_correction_deg, "an angle");
  Require(IsLengthOr0(options.voxel_m), "voxel_m", options.voxel_m, "a length, or 0");
  Require(IsLengthOr0(options.normals.radius_m), "the normals' radius_m", options.normals.radius_m,
          "a length, or 0");
  Require(options.normals.num_neighbors >= 3, "the normals' num_neighbors",
          options.normals.num_neighbors, "at least 3");
  const auto of_features = std::find_if(metrics.begin(), metrics.end(), NeedsFeatures);
  if (options.voxel_m > 0 && of_features != metrics.end()) {
    throw UsageError("voxel_m is " + Number(options.voxel_m) + "; expected 0 with " + *of_features +
                     ", whose edge and planar points are those of whole scan lines.");
  }
}

void CheckMatching(const MatchingOptions& options) {
  Require(options.max_distance_m >= 0, "max_distance_m", options.max_distance_m, "a length, or 0");
  Require(options.max_normal_angle_rad >= 0 && options.max_normal_angle_rad <= M_PI,
          "max_normal_angle_rad", options.max_normal_angle_rad, "an angle from 0 to pi");
  Require(options.max_median_factor >= 0, "max_median_factor", options.max_median_factor,
          "a number of at least 0");
  Require(options.kept_fraction > 0 && options.kept_fraction <= 1, "kept_fraction",
          options.kept_fraction, "above 0, at most 1");
}

void CheckCloud(const PointCloud& cloud, const std::string& role) {
  const auto require = [&](std::size_t size, const char* array, bool optional) {
    if (size != cloud.size() && !(optional && size == 0)) {
      throw InputError("the " + role + " has " + std::to_string(cloud.size()) + " x and " +
                       std::to_string(size) + " " + array + "; expected as many of both" +
                       (optional ? ", or none." : "."));
    }
  };
  require(cloud.y.size(), "y", false);
  require(cloud.z.size(), "z", false);
  require(cloud.intensity.size(), "intensity", true);
  require(cloud.nx.size(), "nx", true);
  require(cloud.ny.size(), "ny", true);
  require(cloud.nz.size(), "nz", true);
  require(cloud.ring.size(), "ring", true);
  require(cloud.label.size(), "label", true);
  require(cloud.time_s.size(), "time_s", true);
}

}  // namespace

void PairOptions::Check() const {
  CheckMetrics(metrics);
  CheckPreparation(preparation, metrics);
  CheckMatching(objective.matching);
  if (!T_initial.Matrix().allFinite()) {
    throw UsageError("A number of T_initial is not finite; expected a rigid motion.");
  }
  Require(threads >= 1, "threads", threads, "at least 1");
}

PreparedClouds PrepareClouds(PointCloud source, PointCloud target, const PairOptions& options) {
  options.Check();
  CheckCloud(source, "source");
  CheckCloud(target, "target");
  DropInvalidPoints(&source);
  DropInvalidPoints(&target);
  for (PointCloud* cloud : {&source, &target}) {
    TakeOutOrigin(cloud);
    DropStrays(cloud);
  }
  ShareOrigin(&source, &target);
  const PairOrigins origins = {source.origin, target.origin};
  return {PreparePair(std::move(source), std::move(target),
                      NeedsOf(options.metrics, options.objective.matching), options.preparation,
                      options.threads),
          origins};
}

}  // namespace icpscape
