// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_FILTER_BIAS_H_
#define ICPSCAPE_APPS_REPORTS_FILTER_BIAS_H_

#include <string>
#include <vector>

#include "apps/run/run.h"
#include "icpscape/io/output.h"
#include "icpscape/paper/filter_bias.h"

namespace icpscape {

/// The minima of every metric along one axis of errors of the predicted pose.
struct FilterSweep {
  ErrorAxis axis;
  std::vector<std::string> metrics;
  std::vector<double> errors;
  std::vector<double> unfiltered;           ///< By metric, without the filter.
  std::vector<std::vector<double>> minima;  ///< By metric, then error.
};

/// Prints and records how the minima follow the errors, metric by metric.
void ReportSweep(const FilterSweep& sweep, Manifest* manifest);

/// Prints and records what the Octree Correspondence Filter removes of the moving points.
void ReportRemoval(const PointCloud& source, const PointCloud& target, const SE3d& T_estimate,
                   double voxel_m, Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_FILTER_BIAS_H_
