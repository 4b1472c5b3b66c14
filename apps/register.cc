// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>

#include "apps/flags/minimizer.h"
#include "apps/flags/objective.h"
#include "apps/flags/pair.h"
#include "apps/flags/pair_filters.h"
#include "apps/reports/ground_truth_check.h"
#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/common/text.h"
#include "src/io/output.h"
#include "src/io/point_files.h"
#include "src/io/transform.h"
#include "src/minimizer/ground_truth_check.h"
#include "src/minimizer/random_starts.h"

DECLARE_int32(seed);

DEFINE_int32(starts, 0, "Random starts about the reference, to measure the success rate.");
DEFINE_double(start_m, 0.5, "Longest translation of a random start (m).");
DEFINE_double(start_deg, 3, "Largest rotation of a random start (degrees).");

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;

void WriteIterations(const std::string& metric, const MinimizerSummary& summary,
                     const std::filesystem::path& out) {
  Table csv({"metric", "iteration", "cost", "rmse", "n", "gradient_norm", "smallest_eigenvalue",
             "largest_eigenvalue", "step_m", "step_deg", "time_s", "qx", "qy", "qz", "qw", "tx_m",
             "ty_m", "tz_m"});
  std::printf("%4s %22s %12s %8s %11s %11s %11s %8s\n", "iter", "cost", "RMSE", "n", "eig min/max",
              "step (m)", "step (deg)", "time (s)");
  for (std::size_t i = 0; i < summary.iterates.size(); ++i) {
    const Iterate& it = summary.iterates[i];
    std::printf("%4zu %22.15g %12.8f %8ld %11.3e %11.3e %11.3e %8.3f\n", i, it.cost, it.rmse, it.n,
                it.smallest_eigenvalue / it.largest_eigenvalue, it.step_m, it.step_rad * kDegrees,
                it.time_s);
    std::vector<std::string> row = {metric,
                                    std::to_string(i),
                                    Number(it.cost),
                                    Number(it.rmse),
                                    std::to_string(it.n),
                                    Number(it.gradient_norm),
                                    Number(it.smallest_eigenvalue),
                                    Number(it.largest_eigenvalue),
                                    Number(it.step_m),
                                    Number(it.step_rad * kDegrees),
                                    Number(it.time_s)};
    double x[7];
    it.T_target_source.ToParameters(x);
    for (const double value : x) {
      row.push_back(Number(value));
    }
    csv.AddRow(std::move(row));
  }
  csv.WriteCsv(out / "iterations.csv");
}

void PrintDifference(const char* what, const SE3d& T_reference, const SE3d& T) {
  const SE3d difference = T_reference.Inverse() * T;
  std::printf("off the %s: %.4f m, %.4f deg\n", what, difference.t().norm(),
              difference.LogRotation().norm() * kDegrees);
}

void RunStarts(const JointObjective& objective, const SE3d& T_reference,
               const MinimizerOptions& options, const std::filesystem::path& out,
               Manifest* manifest) {
  RandomStartOptions starts;
  starts.count = FLAGS_starts;
  starts.translation_m = FLAGS_start_m;
  starts.rotation_rad = FLAGS_start_deg / kDegrees;
  starts.seed = static_cast<unsigned>(FLAGS_seed);
  starts.minimizer = options;
  std::vector<StartResult> results;
  {
    Progress progress("starts", starts.count);
    results =
        RunRandomStarts(objective, T_reference, starts, [&](int done) { progress.Show(done); });
  }
  Table csv({"start", "start_m", "start_deg", "end_m", "end_deg", "iterations", "termination",
             "success"});
  int successes = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const StartResult& r = results[i];
    successes += r.success ? 1 : 0;
    csv.AddRow({std::to_string(i), Number(r.start_m), Number(r.start_rad * kDegrees),
                Number(r.end_m), Number(r.end_rad * kDegrees), std::to_string(r.iterations),
                TerminationName(r.termination), r.success ? "1" : "0"});
  }
  csv.WriteCsv(out / "starts.csv");
  const double rate = 100.0 * successes / static_cast<double>(results.size());
  std::printf(
      "random starts up to %g m, %g deg: %d of %zu succeed (%.1f %%; within %g m and %g "
      "deg of the refined reference)\n",
      FLAGS_start_m, FLAGS_start_deg, successes, results.size(), rate, kSuccessM,
      kSuccessRad * kDegrees);
  manifest->SetResult("success_percent", rate);
  manifest->AddTiming("starts");
}

void CheckFlags() {
  CheckPairFlags(MetricsFromFlags(), FLAGS_starts > 0);
  CheckFilterFlags();
  FeaturesFromFlags();
  ObjectiveSetFromFlags();
  MinimizerFromFlags();
  CheckWeightFlags();
  RequireFlag(FLAGS_starts <= 1000000, "starts", std::to_string(FLAGS_starts), "at most 1e6");
  RequireFlag(FLAGS_start_m <= 1000, "start_m", Number(FLAGS_start_m), "at most 1000");
  if (FLAGS_starts < 0 || !(FLAGS_start_m >= 0) || !(FLAGS_start_deg >= 0) ||
      !(FLAGS_start_deg < 180)) {
    throw UsageError("--starts, --start_m, --start_deg: expected at least 0, and below 180 deg.");
  }
}

void Register() {
  CheckFlags();
  const std::vector<std::string> metrics = MetricsFromFlags();
  const MinimizerOptions options = MinimizerFromFlags();
  const std::filesystem::path out = OutputFolder();
  Manifest manifest(AppName());
  RecordFlags(&manifest);
  ScanPair pair = ReadPair(&manifest);
  const SE3d T_initial = InitialPose(pair, &manifest);
  const PreparedPair scans = PrepareFromFlags(metrics, &pair, &manifest);
  std::optional<GroundTruthCheck> check;
  if (pair.T_ground_truth) {
    check =
        ReportGroundTruthCheck(pair, scans, FLAGS_starts > 0, ThreadsFromFlags(), &manifest);
  }
  const ObjectiveSet set(FilterFromFlags(scans, pair, &manifest), metrics, ObjectiveSetFromFlags());
  const JointObjective objective = JointFromFlags(set.objectives());
  const MinimizerSummary summary = Minimize(objective, T_initial, options);
  manifest.AddTiming("register");
  if (!summary.Usable()) {
    throw ComputationError(objective.Name() + ": " + summary.message);
  }
  const SE3d& T = summary.T_target_source();
  WriteIterations(objective.Name(), summary, out);
  std::printf("%s: %s\nfinal cost: %s\n", TerminationName(summary.termination),
              summary.message.c_str(), Number(summary.final_cost()).c_str());
  manifest.SetResult("termination", TerminationName(summary.termination));
  manifest.SetResult("final_cost", summary.final_cost());
  manifest.SetResult("matching_passes", summary.matching_passes);
  manifest.SetResult("searches_built", static_cast<double>(SearchesBuilt()));
  WriteTextFile(out / "T_target_source.txt", FormatTransform(T));
  WritePly(out / "aligned.ply", scans.source.cloud().Transformed(T));
  if (pair.T_ground_truth) {
    PrintDifference("ground truth", *pair.T_ground_truth, T);
  }
  if (check) {
    PrintDifference("refined reference", check->T_refined, T);
    if (FLAGS_starts > 0) {
      RunStarts(objective, check->T_refined, options, out, &manifest);
    }
  }
  const bool drawn =
      RunPlotScript("plot_iterations.py", {(out / "iterations.csv").string(), "--out",
                                           (out / "iterations").string(), "--title", pair.title});
  manifest.AddTiming("figures");
  manifest.Write(out / "manifest.json");
  std::cout << "time: " << manifest.TimingsText() << '\n';
  std::cout << "written: " << (out / "T_target_source.txt").string() << ", iterations.csv"
            << (drawn ? ", iterations.svg, iterations.png" : "")
            << ", aligned.ply (the source, moved onto the target)"
            << (FLAGS_starts > 0 ? ", starts.csv" : "") << ", manifest.json\n";
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  // landscape's default draws three metrics; here all that are named are minimised together.
  gflags::SetCommandLineOptionWithMode("metrics", "point_to_plane", gflags::SET_FLAGS_DEFAULT);
  return icpscape::RunApp(argc, argv,
                          "registers two scans: minimises the objective of one metric, or the "
                          "weighted sum of several, with Ceres: the closed loop.",
                          icpscape::Register);
}
