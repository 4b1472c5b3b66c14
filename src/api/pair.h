// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_API_PAIR_H_
#define ICPSCAPE_SRC_API_PAIR_H_

#include <string>
#include <vector>

#include "icpscape/cloud/origin.h"
#include "icpscape/objective/objective_set.h"
#include "icpscape/preparation/prepared_scan.h"

namespace icpscape {

/// Options of Register, Landscape and Covariance for a pair of clouds. The defaults are those of
/// the programs.
struct PairOptions {
  /// Objective functions by name; see docs/metrics.md, and icpscape-list_metrics.
  std::vector<std::string> metrics;
  /// What is done to both clouds first: voxels, normals, edge and planar points.
  PreparationOptions preparation;
  /// Which points form pairs, and the loss on their residuals.
  ObjectiveSetOptions objective;
  /// The start of a registration, and u = 0 of a landscape.
  SE3d T_initial;
  /// No result depends on it.
  int threads = 1;

  /// Throws UsageError naming what is out of range.
  void Check() const;
};

/// Two clouds, prepared. Poses are between their frames, less what was taken out of the
/// coordinates; `origins` takes poses of the user there and back.
struct PreparedClouds {
  PreparedPair scans;
  PairOrigins origins;
};

/// Two clouds, checked and prepared for the metrics; what the three calls begin with. Points that
/// no registration can use are dropped: those that are not finite or 1000 km out, and those at 0.
/// Normals are estimated and look to PointCloud::sensor; ones in the clouds are replaced. A cloud
/// that lies more than 1000 m out has its middle taken out, unless it has an origin already.
///
/// Throws UsageError for options out of range, InputError where an array of a cloud has another
/// length than x, or where edge and planar points are asked for and scan lines cannot be found.
PreparedClouds PrepareClouds(PointCloud source, PointCloud target, const PairOptions& options);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_API_PAIR_H_
