// SPDX-License-Identifier: BSD-3-Clause
#include "src/landscape/curve.h"

#include <gflags/gflags.h>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "apps/flags/minimizer.h"
#include "apps/flags/objective.h"
#include "apps/flags/pair.h"
#include "apps/flags/pair_filters.h"
#include "apps/reports/ground_truth_check.h"
#include "apps/reports/iterates.h"
#include "apps/run/app.h"
#include "residuals/registry.h"
#include "src/common/error.h"
#include "src/common/text.h"
#include "src/io/output.h"

DEFINE_double(u_min, -1, "Start of the path; u = 0 is --initial, u = 1 the reference pose.");
DEFINE_double(u_max, 2, "End of the path.");
DEFINE_int32(samples, 100, "Poses along the path, both ends included.");
DEFINE_string(path, "lerp_slerp",
              "lerp_slerp (the paper's, sec. 3.1), geodesic (constant twist in SE(3)) or bicycle "
              "(constant speed and steering).");
DEFINE_string(reference, "ground_truth",
              "Pose at u = 1: ground_truth as given, or refined by point-to-plane.");
DEFINE_string(column, "rmse",
              "What is drawn and whose minimum is printed: rmse (sqrt(eps / n), the paper's), "
              "rms_residual (sqrt(sum |r|^2 / n)), rmse_fixed_n (n of u = 1), epsilon, cost or "
              "inlier_ratio. The table has all of them.");
DEFINE_string(patch_offset, "per_term",
              "Ones subtracted from planar_to_patch: per_term, total (one in all) or none (paper "
              "sec. 4.2 allows the first two).");
DEFINE_string(association, "reassociate",
              "reassociate (pairs of each pose, as in ICP) or frozen (pairs of --frozen_u).");
DEFINE_double(frozen_u, 1, "Where the frozen pairs are taken.");
DEFINE_bool(iterates, false,
            "Minimise each metric from --initial as well, and draw the iterates at their nearest u "
            "with their distance from the path.");

namespace icpscape {
namespace {

void WriteCurves(const std::vector<Curve>& curves, const std::filesystem::path& out) {
  // Tables and figures of an earlier run must not stand beside this run's.
  for (const char* file : {"iterates.csv", "iterations.svg", "iterations.png"}) {
    std::filesystem::remove(out / file);
  }
  ForEachMetric([&](auto tag) {
    std::filesystem::remove(out / (std::string(decltype(tag)::Metric::kName) + "_rmse.txt"));
  });
  Table csv({"metric", "u", "rmse", "rms_residual", "cost", "n", "slope_analytic", "slope_numeric",
             "inlier_ratio", "epsilon", "rmse_fixed_n"});
  for (const Curve& curve : curves) {
    Table pgfplots({"u", "rmse"});
    for (const CurvePoint& p : curve.points) {
      csv.AddRow({curve.metric, Number(p.u), Number(p.rmse), Number(p.rms_residual), Number(p.cost),
                  Number(p.n), Number(p.slope_analytic), Number(p.slope_numeric),
                  Number(p.inlier_ratio), Number(p.epsilon), Number(p.rmse_fixed_n)});
      pgfplots.AddRow({Number(p.u), Number(p.rmse)});
    }
    pgfplots.WritePgfplots(out / (curve.metric + "_rmse.txt"));
  }
  csv.WriteCsv(out / "curves.csv");
}

void PrintMinima(const std::vector<Curve>& curves, double motion_m, Manifest* manifest) {
  std::printf("%-18s %8s %14s %18s %9s\n", "metric", "argmin u", "off by (m)",
              (FLAGS_column + " there").c_str(), "n");
  for (const Curve& curve : curves) {
    const auto value = CurveColumnFromName(FLAGS_column).value;
    const CurvePoint& minimum = curve.Minimum(value);
    std::printf("%-18s %8.4f %14.4f %18.6f %9.0f\n", curve.metric.c_str(), minimum.u,
                std::abs(minimum.u - 1) * motion_m, minimum.*value, minimum.n);
    manifest->SetResult("argmin_u_" + curve.metric, minimum.u);
  }
}

bool IsDefault(const char* flag) {
  const gflags::CommandLineFlagInfo info = gflags::GetCommandLineFlagInfoOrDie(flag);
  return info.current_value == info.default_value;
}

// Iterates belong on the curve of what is minimised; the minimiser's flags belong to iterates.
void CheckIterateFlags() {
  if (!FLAGS_iterates) {
    for (const char* flag : {"reassociation", "max_iterations", "min_step_m", "min_step_deg",
                             "min_cost_change", "max_final_cost", "dof"}) {
      RequireFlag(IsDefault(flag), flag, gflags::GetCommandLineFlagInfoOrDie(flag).current_value,
                  "--iterates with it");
    }
    return;
  }
  MinimizerFromFlags();
  RequireFlag(FLAGS_column == "rmse" || FLAGS_column == "cost", "column", FLAGS_column,
              "rmse or cost with --iterates");
  RequireFlag(FLAGS_association == "reassociate", "association", FLAGS_association,
              "reassociate with --iterates");
  RequireFlag(FLAGS_patch_offset == "per_term", "patch_offset", FLAGS_patch_offset,
              "per_term with --iterates");
}

void CheckFlags(const CurveOptions& options) {
  CheckPairFlags(MetricsFromFlags(), true);
  CheckFilterFlags();
  FeaturesFromFlags();
  ObjectiveSetFromFlags();
  options.Check();
  PathKindFromName(FLAGS_path);
  CurveColumnFromName(FLAGS_column);
  if (FLAGS_reference != "ground_truth" && FLAGS_reference != "refined") {
    throw UsageError("--reference=" + FLAGS_reference + ": expected ground_truth or refined.");
  }
  RequireFlag(std::isfinite(FLAGS_frozen_u) && std::abs(FLAGS_frozen_u) <= 1e6, "frozen_u",
              Number(FLAGS_frozen_u), "a number of at most 1e6");
  if (FLAGS_association != "reassociate" && FLAGS_association != "frozen") {
    throw UsageError("--association=" + FLAGS_association + ": expected reassociate or frozen.");
  }
  RequireFlag(IsDefault("weights"), "weights",
              gflags::GetCommandLineFlagInfoOrDie("weights").current_value,
              "none, since each metric has a curve of its own");
  CheckIterateFlags();
}

// ", --octree_voxel_m=0.1": what sets the curves apart from the default, for the title.
std::string ChangedFlags() {
  std::string text;
  for (const char* flag : {"path",
                           "reference",
                           "initial",
                           "reverse",
                           "column",
                           "patch_offset",
                           "voxel_m",
                           "artificial_blind_spot_m",
                           "ego_filter_m",
                           "octree_voxel_m",
                           "filter_estimate",
                           "reciprocal",
                           "reciprocal_epsilon_m",
                           "max_distance_m",
                           "max_normal_angle_deg",
                           "max_median_factor",
                           "kept_fraction",
                           "region_size_m",
                           "region_median_factor",
                           "loss",
                           "smoothness",
                           "smoothness_neighborhood",
                           "ring_points_per_side",
                           "smoothness_neighbors",
                           "smoothness_radius_m",
                           "planar_below",
                           "edge_from",
                           "feature_caps",
                           "fit_neighbors",
                           "fit_eigenvalue_ratio",
                           "fit_max_smallest_eigenvalue_m2",
                           "fit_eigenvalue_scale",
                           "fit_anchor",
                           "fit_max_neighbor_distance_m",
                           "patch_leg_m",
                           "normal_neighbors",
                           "normal_radius_m",
                           "elevation_correction_deg",
                           "reassociation",
                           "max_iterations",
                           "min_step_m",
                           "min_step_deg",
                           "min_cost_change",
                           "max_final_cost",
                           "dof"}) {
    const gflags::CommandLineFlagInfo info = gflags::GetCommandLineFlagInfoOrDie(flag);
    const bool has_a_say = info.name != "loss" || FLAGS_column == "cost" || FLAGS_iterates;
    if (info.current_value != info.default_value && has_a_say) {
      text += ", --" + info.name + "=" + info.current_value;
    }
  }
  return text;
}

// Prints how far point-to-plane moves from the ground truth, and returns the pose for u = 1.
SE3d ReferencePose(const ScanPair& pair, const PreparedPair& scans, Manifest* manifest) {
  const SE3d truth = *pair.T_ground_truth;
  std::printf("motion: %.4f m, %.4f deg\n", truth.t().norm(),
              truth.LogRotation().norm() * 180 / M_PI);
  const auto check = ReportGroundTruthCheck(pair, scans, FLAGS_reference == "refined",
                                           ThreadsFromFlags(), manifest);
  return FLAGS_reference == "refined" ? check->T_refined : truth;
}

// Whether there are figures.
bool Draw(const std::filesystem::path& out, const std::string& scans,
          const std::string& association) {
  const std::string changed = ChangedFlags();
  const std::string iterates = (out / "iterates.csv").string();
  std::vector<std::string> arguments = {(out / "curves.csv").string(),
                                        "--out",
                                        (out / "landscape").string(),
                                        "--column",
                                        FLAGS_column,
                                        "--title",
                                        scans + "\n" + association + changed};
  if (!FLAGS_iterates) {
    return RunPlotScript("plot_curves.py", arguments);
  }
  arguments.insert(arguments.end(), {"--iterates", iterates});
  return RunPlotScript("plot_curves.py", arguments) &&
         RunPlotScript("plot_iterations.py",
                       {iterates, "--out", (out / "iterations").string(), "--column", FLAGS_column,
                        "--title", scans + changed});
}

void Landscape() {
  CurveOptions options;
  options.u_min = FLAGS_u_min;
  options.u_max = FLAGS_u_max;
  options.samples = FLAGS_samples;
  options.threads = ThreadsFromFlags();
  options.patch_offset = PatchOffsetFromName(FLAGS_patch_offset);
  CheckFlags(options);
  const std::filesystem::path out = OutputFolder();
  const std::vector<std::string> metrics = MetricsFromFlags();
  Manifest manifest(AppName());
  RecordFlags(&manifest);
  ScanPair pair = ReadPair(&manifest);
  const SE3d T_initial = InitialPose(pair, &manifest);
  const PreparedPair scans = PrepareFromFlags(metrics, &pair, &manifest);
  const SE3d T_reference = ReferencePose(pair, scans, &manifest);

  const ObjectiveSet set(FilterFromFlags(scans, pair, &manifest), metrics, ObjectiveSetFromFlags());
  const Path path(T_initial, T_reference, PathKindFromName(FLAGS_path));
  std::string association = "re-associated at every pose";
  if (FLAGS_association == "frozen") {
    options.frozen_u = FLAGS_frozen_u;
    association = "matches frozen at u = " + Number(FLAGS_frozen_u);
  }
  std::vector<Curve> curves;
  {
    Progress progress("poses", options.samples);
    curves =
        EvaluateCurves(set.objectives(), path, options, [&](int done) { progress.Show(done); });
  }
  manifest.AddTiming("landscape");

  PrintMinima(curves, (T_reference.t() - T_initial.t()).norm(), &manifest);
  WriteCurves(curves, out);
  if (FLAGS_iterates) {
    ReportIterates(MinimizeEach(set.objectives(), T_initial, MinimizerFromFlags()), path,
                   options, out, &manifest);
    manifest.AddTiming("iterates");
  }
  const bool drawn = Draw(out, pair.title, association);
  manifest.AddTiming("figures");
  manifest.Write(out / "manifest.json");
  std::cout << "time: " << manifest.TimingsText() << '\n';
  std::cout << "written: " << (out / "curves.csv").string()
            << (FLAGS_iterates ? ", iterates.csv" : "")
            << (drawn ? ", landscape.svg, landscape.png" : "")
            << (drawn && FLAGS_iterates ? ", iterations.svg, iterations.png" : "")
            << ", a METRIC_rmse.txt for pgfplots each, manifest.json\n";
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv,
                          "draws the objective functions of ICP along a path of poses from the "
                          "start (u = 0) to the true motion (u = 1): the open loop.",
                          icpscape::Landscape);
}
