// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/filter_bias.h"

#include <cmath>
#include <cstdio>

#include "icpscape/cloud/label.h"
#include "icpscape/filtering/filter_statistics.h"
#include "icpscape/filtering/octree_correspondence_filter.h"

namespace icpscape {

void ReportSweep(const FilterSweep& sweep, Manifest* manifest) {
  const ErrorAxis& axis = sweep.axis;
  for (std::size_t m = 0; m < sweep.metrics.size(); ++m) {
    const std::string& metric = sweep.metrics[m];
    const double slope = RegressionSlope(sweep.errors, sweep.minima[m]);
    const double unfiltered = sweep.unfiltered[m];
    std::printf("%-10s %-16s slope %6.3f; unfiltered: %8.4f %s%s\n", axis.name.c_str(),
                metric.c_str(), slope, unfiltered, axis.unit.c_str(),
                std::abs(unfiltered) < 2 * axis.range ? "" : " or beyond");
    manifest->SetResult("slope_" + axis.name + "_" + metric, slope);
    manifest->SetResult("unfiltered_" + axis.name + "_" + metric, unfiltered);
  }
  manifest->AddTiming(axis.name);
}

void ReportRemoval(const PointCloud& source, const PointCloud& target, const SE3d& T_estimate,
                   double voxel_m, Manifest* manifest) {
  const auto is_moving = [](std::int32_t label) { return IsMoving(SemanticOf(label)); };
  const KeptPoints kept = OctreeCorrespondenceFilter(source, target, T_estimate, {voxel_m});
  const RemovalScore score = ScoreRemoval(source, kept.source, is_moving);
  // Two points in one voxel are at most its diagonal apart.
  const DynamicRemains remains = FindDynamicRemains(source, target, kept.source, T_estimate,
                                                    std::sqrt(3.0) * voxel_m, is_moving);
  std::printf("with the predicted pose the filter keeps %.1f %% of the source\n",
              100 * CountKept(kept.source).Fraction());
  std::printf("moving points: %zu; removed: %zu; recall %.3f, precision %.3f\n", score.dynamic,
              score.dynamic_removed, score.Recall(), score.Precision());
  std::printf(
      "moving points where their object's two poses overlap: %zu of all, %zu of the %zu "
      "that remain\n",
      remains.overlapping, remains.kept_overlapping, remains.kept);
  manifest->SetResult("removal_recall", score.Recall());
  manifest->SetResult("removal_precision", score.Precision());
  manifest->SetResult("moving_points", static_cast<double>(remains.dynamic));
  manifest->SetResult("moving_overlapping", static_cast<double>(remains.overlapping));
  manifest->SetResult("moving_kept", static_cast<double>(remains.kept));
  manifest->SetResult("moving_kept_overlapping", static_cast<double>(remains.kept_overlapping));
}

}  // namespace icpscape
