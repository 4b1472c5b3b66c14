// SPDX-License-Identifier: BSD-3-Clause
#include "src/paper/filter_bias.h"

#include <gflags/gflags.h>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "apps/flags/objective.h"
#include "apps/flags/pair.h"
#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/common/text.h"
#include "src/filtering/filter_chain.h"
#include "src/filtering/filter_statistics.h"
#include "src/filtering/octree_correspondence_filter.h"
#include "src/io/output.h"
#include "src/simulation/surface.h"

DECLARE_double(voxel_m);
DEFINE_double(octree_voxel_m, 0.1, "Voxels of the Octree Correspondence Filter (m).");
DEFINE_double(translation_range_m, 0.3, "Errors of T_e along the path, to either side (m).");
DEFINE_double(yaw_range_deg, 0.5, "Errors of T_e in yaw, to either side (degrees).");
DEFINE_int32(steps, 7, "Errors tried per sweep, both ends included.");
DEFINE_int32(samples, 41, "Poses per search of a minimum, over twice the range of the errors.");

namespace icpscape {
namespace {

PreparedPair FilteredBy(const PreparedPair& scans, const SE3d& T_estimate) {
  FilterOptions octree;
  octree.octree_voxel_m = FLAGS_octree_voxel_m;
  return scans.Select(
      ApplyFilters(scans.source.cloud(), scans.target.cloud(), T_estimate, octree),
      ThreadsFromFlags());
}

// The minima of all metrics under filters with every error of T_e, and (as "unfiltered") without.
void Sweep(const PreparedPair& scans, const std::vector<std::string>& metrics, const ErrorAxis& axis,
           Table* table, Manifest* manifest) {
  const int threads = ThreadsFromFlags();
  std::vector<double> errors;
  std::vector<std::vector<double>> minima(metrics.size());
  const auto evaluate = [&](const PreparedPair& pair, const std::string& error) {
    const ObjectiveSet set(pair, metrics, ObjectiveSetFromFlags());
    std::vector<double> found;
    for (const Objective& objective : set.objectives()) {
      found.push_back(ArgminError(objective, axis, FLAGS_samples, threads));
      table->AddRow({axis.name, axis.unit, objective.metric(), error, Number(found.back()),
                     std::to_string(pair.source.cloud().size())});
    }
    return found;
  };
  const std::vector<double> unfiltered = evaluate(scans, "unfiltered");
  Progress progress("filters, " + axis.name, FLAGS_steps);
  for (int i = 0; i < FLAGS_steps; ++i) {
    const double error = axis.range * (2.0 * i / (FLAGS_steps - 1) - 1);
    const std::vector<double> found =
        evaluate(FilteredBy(scans, axis.pose(error)), Number(error));
    errors.push_back(error);
    for (std::size_t m = 0; m < metrics.size(); ++m) {
      minima[m].push_back(found[m]);
    }
    progress.Show(i + 1);
  }
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const double slope = RegressionSlope(errors, minima[m]);
    std::printf("%-10s %-16s slope %6.3f; unfiltered: %8.4f %s%s\n", axis.name.c_str(),
                metrics[m].c_str(), slope, unfiltered[m], axis.unit.c_str(),
                std::abs(unfiltered[m]) < 2 * axis.range ? "" : " or beyond");
    manifest->SetResult("slope_" + axis.name + "_" + metrics[m], slope);
    manifest->SetResult("unfiltered_" + axis.name + "_" + metrics[m], unfiltered[m]);
  }
  manifest->AddTiming(axis.name);
}

// What the filter with the motion of the frame before removes of the moving objects.
void ReportRemoval(const PreparedPair& scans, const std::optional<SE3d>& T_predicted,
                   Manifest* manifest) {
  const PointCloud& source = scans.source.cloud();
  const PointCloud& target = scans.target.cloud();
  if (!T_predicted || source.label.empty()) {
    return;
  }
  const auto is_moving = [](std::int32_t label) { return IsMoving(SemanticOf(label)); };
  const KeptPoints kept =
      OctreeCorrespondenceFilter(source, target, *T_predicted, {FLAGS_octree_voxel_m});
  const RemovalScore score = ScoreRemoval(source, kept.source, is_moving);
  // Two points in one voxel are at most its diagonal apart.
  const DynamicRemains remains =
      FindDynamicRemains(source, target, kept.source, *T_predicted,
                         std::sqrt(3.0) * FLAGS_octree_voxel_m, is_moving);
  std::printf("T_e = previous motion: keeps %.1f %% of the source\n",
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

void FilterBias() {
  const std::vector<std::string> metrics = MetricsFromFlags();
  CheckPairFlags(metrics, true);
  for (const char* flag : {"loss", "initial"}) {
    const gflags::CommandLineFlagInfo info = gflags::GetCommandLineFlagInfoOrDie(flag);
    RequireFlag(info.current_value == info.default_value, flag, info.current_value,
                "its default, since the paper's RMSE along the path knows neither loss nor start");
  }
  RequireFlag(FLAGS_voxel_m == 0, "voxel_m", Number(FLAGS_voxel_m),
              "0, since the filter's removal is counted on labelled points, and centroids have no "
              "labels");
  FeaturesFromFlags();
  ObjectiveSetFromFlags();
  RequireFlag(FLAGS_octree_voxel_m > 0, "octree_voxel_m", Number(FLAGS_octree_voxel_m),
              "a positive length");
  RequireFlag(FLAGS_translation_range_m > 0, "translation_range_m",
              Number(FLAGS_translation_range_m), "a positive length");
  RequireFlag(FLAGS_yaw_range_deg > 0, "yaw_range_deg", Number(FLAGS_yaw_range_deg),
              "a positive angle");
  RequireFlag(FLAGS_steps >= 2, "steps", std::to_string(FLAGS_steps), "at least 2");
  RequireFlag(FLAGS_samples >= 3, "samples", std::to_string(FLAGS_samples), "at least 3");
  const std::filesystem::path out = OutputFolder();
  Manifest manifest(AppName());
  RecordFlags(&manifest);
  ScanPair pair = ReadPair(&manifest);
  if (!pair.T_ground_truth) {
    throw UsageError(
        "no ground truth: expected --ground_truth=FILE (T_target_source as 4x4 text).");
  }
  const PreparedPair scans = PrepareFromFlags(metrics, &pair, &manifest);
  Table table({"sweep", "unit", "metric", "error_of_estimate", "argmin_error", "source_points"});
  Sweep(scans, metrics, AlongPath(*pair.T_ground_truth, FLAGS_translation_range_m), &table,
        &manifest);
  Sweep(scans, metrics, Yaw(*pair.T_ground_truth, FLAGS_yaw_range_deg), &table, &manifest);
  ReportRemoval(scans, pair.T_predicted, &manifest);
  table.WriteCsv(out / "filter_bias.csv");
  RunPlotScript("plot_filter_bias.py", {(out / "filter_bias.csv").string(), "--out",
                                        (out / "filter_bias").string(), "--title", pair.title});
  manifest.AddTiming("figures");
  manifest.Write(out / "manifest.json");
  std::cout << "written: " << (out / "filter_bias.csv").string()
            << ", filter_bias.svg, filter_bias.png, manifest.json\n";
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(
      argc, argv,
      "asks whether the Octree Correspondence Filter finds the motion or returns its prior T_e: "
      "where each metric's minimum goes when T_e is moved. Slope 1 is the prior, 0 the data.",
      icpscape::FilterBias);
}
