// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/api/landscape.h"

#include <utility>

#include "icpscape/common/error.h"

namespace icpscape {

LandscapeOptions::LandscapeOptions() {
  metrics = {"point_to_point", "point_to_plane", "symmetric"};
}

LandscapeResult Landscape(PointCloud source, PointCloud target, const SE3d& T_reference,
                          const LandscapeOptions& options) {
  if (!T_reference.Matrix().allFinite()) {
    throw UsageError("A number of T_reference is not finite; expected a rigid motion.");
  }
  CurveOptions curve = options.curve;
  curve.threads = options.threads;
  curve.Check();
  const auto [scans, origins] = PrepareClouds(std::move(source), std::move(target), options);
  const Path path(origins.FromUser(options.T_initial), origins.FromUser(T_reference), options.path,
                  scans.source.cloud().sensor);
  const ObjectiveSet set(scans, options.metrics, options.objective);
  return {EvaluateCurves(set.objectives(), path, curve), path, origins};
}

}  // namespace icpscape
