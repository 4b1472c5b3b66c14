// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <string>
#include <vector>

#include "apps/flags/objective.h"
#include "apps/flags/octree_filter.h"
#include "apps/flags/pair.h"
#include "apps/reports/filter_bias.h"
#include "apps/run/app.h"
#include "apps/run/progress.h"
#include "apps/run/run.h"
#include "icpscape/common/text.h"
#include "icpscape/filtering/filter_chain.h"

DECLARE_double(voxel_m);
DECLARE_string(initial);
DEFINE_double(translation_range_m, 0.3, "Largest error of the predicted pose along the path (m).");
DEFINE_double(yaw_range_deg, 0.5, "Largest error of the predicted pose in yaw (degrees).");
DEFINE_int32(steps, 7, "Errors tried per sweep, both ends included.");
static const icpscape::FlagMark steps_mark(&FLAGS_steps, icpscape::kShown);
DEFINE_int32(samples, 41, "Poses per search of a minimum, over twice the range of the errors.");

namespace icpscape {
namespace {

void CheckFlags() {
  CheckPairFlags(MetricsFromFlags(), true);
  FeaturesFromFlags();
  ObjectiveSetFromFlags();
  RequireUnchanged([](const Flag& flag) { return flag.Has(kCostOnly); },
                   "its default, since the paper's RMSE has no loss");
  RequireFlag(FLAGS_initial == "identity", "initial", FLAGS_initial,
              "identity, since the search for minima needs no start");
  RequireFlag(FLAGS_voxel_m == 0, "voxel_m", Number(FLAGS_voxel_m),
              "0, since the filter's removal is counted on labelled points, and centroids have no "
              "labels");
  RequireFlag(OctreeVoxelFromFlags() > 0, "octree_voxel_m", Number(OctreeVoxelFromFlags()),
              "a positive length");
  RequireFlag(FLAGS_translation_range_m > 0, "translation_range_m",
              Number(FLAGS_translation_range_m), "a positive length");
  RequireFlag(FLAGS_yaw_range_deg > 0, "yaw_range_deg", Number(FLAGS_yaw_range_deg),
              "a positive angle");
  RequireFlag(FLAGS_steps >= 2, "steps", std::to_string(FLAGS_steps), "at least 2");
  RequireFlag(FLAGS_samples >= 3, "samples", std::to_string(FLAGS_samples), "at least 3");
}

PreparedPair FilteredWith(const SE3d& T_estimate, const PreparedPair& scans) {
  FilterOptions octree;
  octree.octree_voxel_m = OctreeVoxelFromFlags();
  return scans.Select(ApplyFilters(scans.source.cloud(), scans.target.cloud(), T_estimate, octree),
                      ThreadsFromFlags());
}

// The minima of all metrics, filtered with each error of the predicted pose and unfiltered.
FilterSweep SweepEstimate(const PreparedPair& scans, const ErrorAxis& axis, Table* table) {
  FilterSweep sweep = {axis, MetricsFromFlags(), {}, {}, {}};
  const auto minima_of = [&](const PreparedPair& pair, const std::string& error) {
    const ObjectiveSet set(pair, sweep.metrics, ObjectiveSetFromFlags());
    std::vector<double> found;
    for (const Objective& objective : set.objectives()) {
      found.push_back(ArgminError(objective, axis, FLAGS_samples, ThreadsFromFlags()));
      table->AddRow({axis.name, axis.unit, objective.metric().name, error, Number(found.back()),
                     std::to_string(pair.source.cloud().size())});
    }
    return found;
  };
  sweep.unfiltered = minima_of(scans, "unfiltered");
  sweep.minima.resize(sweep.metrics.size());
  Progress progress("filters, " + axis.name, FLAGS_steps);
  for (int i = 0; i < FLAGS_steps; ++i) {
    const double error = axis.range * (2.0 * i / (FLAGS_steps - 1) - 1);
    const auto found = minima_of(FilteredWith(axis.pose(error), scans), Number(error));
    sweep.errors.push_back(error);
    for (std::size_t m = 0; m < found.size(); ++m) {
      sweep.minima[m].push_back(found[m]);
    }
    progress.Show(i + 1);
  }
  return sweep;
}

void FilterBias() {
  CheckFlags();
  Run run;
  ScanPair pair = ReadPair(run.manifest());
  const PreparedPair scans = PrepareFromFlags(MetricsFromFlags(), &pair, run.manifest());
  Table table({"sweep", "unit", "metric", "error_of_estimate", "argmin_error", "source_points"});
  const Vec3& sensor = scans.source.cloud().sensor;
  for (const ErrorAxis& axis : {AlongPath(*pair.T_ground_truth, sensor, FLAGS_translation_range_m),
                                Yaw(*pair.T_ground_truth, sensor, FLAGS_yaw_range_deg)}) {
    ReportSweep(SweepEstimate(scans, axis, &table), run.manifest());
  }
  if (pair.T_predicted && !scans.source.cloud().label.empty()) {
    ReportRemoval(scans.source.cloud(), scans.target.cloud(), *pair.T_predicted,
                  OctreeVoxelFromFlags(), run.manifest());
  }
  const std::filesystem::path path = run.File("filter_bias.csv");
  table.WriteCsv(path);
  run.Draw("plot_filter_bias.py", {path.string(), "--title", TitleWithFlags(pair.title)},
           "filter_bias");
  run.manifest()->AddTiming("figures");
  run.Finish();
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  icpscape::SetFlagDefault("octree_voxel_m",
                           "0.1");  // The paper's: here the filter is the subject.
  return icpscape::RunApp(
      argc, argv,
      "asks whether the Octree Correspondence Filter finds the motion or returns its predicted "
      "pose: slope 1 means that each minimum follows the predicted pose, slope 0 that it stays.",
      icpscape::FilterBias);
}
