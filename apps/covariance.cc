// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "apps/flags/lidar.h"
#include "apps/flags/objective.h"
#include "apps/flags/pair.h"
#include "apps/flags/pair_filters.h"
#include "apps/flags/preparation.h"
#include "apps/reports/covariance.h"
#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/common/text.h"
#include "src/covariance/monte_carlo.h"

DECLARE_string(scene);

DEFINE_int32(draws, 100,
             "Monte-Carlo draws, with --scene; 0 is none: the report on one pair alone.");
DEFINE_string(
    sensor, "redrawn",
    "The lasers' constant errors: redrawn in every draw (a lidar that one does not know), "
    "or fixed (always the lidar of --seed: its errors are bias).");
DEFINE_double(start_m, 0.5, "Longest translation of a draw's start from the truth (m).");
DEFINE_double(start_deg, 3, "Largest rotation of a draw's start from the truth (degrees).");
DEFINE_double(assumed_range_noise_m, icpscape::CovarianceOptions().range_noise_m,
              "Standard deviation of independent range noise that Censi's formula is told (m).");
DEFINE_double(
    assumed_ring_bias_m, icpscape::CovarianceOptions().ring_bias_m,
    "Standard deviation of the lasers' constant errors that censi_ring_bias is told (m).");
DEFINE_double(cluster_m, icpscape::CovarianceOptions().cluster_m,
              "Cubes whose pairs count as correlated in the clustered sandwich (m).");
DEFINE_double(rematching_step_m, icpscape::CovarianceOptions().rematching_step_m,
              "Half the distance over which sandwich_rematched differences its Hessian (m).");
DEFINE_double(length_scale_m, 10,
              "Lever arm L at which rotations are measured as lengths: eigenvalues and directions "
              "are those of the Hessian in [L omega; v] (m).");

namespace icpscape {
namespace {

CovarianceOptions CovarianceFromFlags() {
  CovarianceOptions options;
  options.range_noise_m = FLAGS_assumed_range_noise_m;
  options.ring_bias_m = FLAGS_assumed_ring_bias_m;
  options.cluster_m = FLAGS_cluster_m;
  options.rematching_step_m = FLAGS_rematching_step_m;
  options.Check();
  return options;
}

Sensor SensorFromFlags() {
  return static_cast<Sensor>(IndexOfName("sensor", FLAGS_sensor, {"fixed", "redrawn"}));
}

// Without --scene there are none.
int DrawsFromFlags() {
  const auto is_default = [](const char* flag) {
    const gflags::CommandLineFlagInfo info = gflags::GetCommandLineFlagInfoOrDie(flag);
    return info.current_value == info.default_value;
  };
  if (FLAGS_scene.empty()) {
    RequireFlag(FLAGS_draws == 0 || gflags::GetCommandLineFlagInfoOrDie("draws").is_default,
                "draws", std::to_string(FLAGS_draws),
                "0 without --scene, since only simulated scans can be drawn anew");
    return 0;
  }
  RequireFlag(FLAGS_draws == 0 || (FLAGS_draws >= 2 && FLAGS_draws <= 100000), "draws",
              std::to_string(FLAGS_draws), "0, or 2 to 100000");
  for (const char* flag : {"voxel_m", "reverse", "artificial_blind_spot_m", "ego_filter_m",
                           "octree_voxel_m", "elevation_correction_deg"}) {
    if (FLAGS_draws != 0 && !is_default(flag)) {
      throw UsageError(std::string("--") + flag +
                       " with draws: expected --draws=0, since draws are "
                       "of simulated pairs as they are.");
    }
  }
  return FLAGS_draws;
}

MonteCarloOptions MonteCarloFromFlags() {
  MonteCarloOptions options;
  options.scene = FLAGS_scene;
  options.seed = SeedFromFlags();
  options.lidar = LidarFromFlags();
  options.sensor = SensorFromFlags();
  options.metrics = MetricsFromFlags();
  options.preparation = PreparationFromFlags(options.metrics);
  options.objective = ObjectiveSetFromFlags();
  RequireFlag(FLAGS_start_m >= 0 && FLAGS_start_m <= 1000, "start_m", Number(FLAGS_start_m),
              "0 to 1000 m");
  RequireFlag(FLAGS_start_deg >= 0 && FLAGS_start_deg < 180, "start_deg", Number(FLAGS_start_deg),
              "0 to less than 180 degrees");
  options.start.translation_m = FLAGS_start_m;
  options.start.rotation_rad = FLAGS_start_deg * M_PI / 180;
  options.start.minimizer = PreciseMinimizer();
  options.covariance = CovarianceFromFlags();
  options.draws = DrawsFromFlags();
  options.threads = ThreadsFromFlags();
  return options;
}

void RunDraws(const std::filesystem::path& out, const std::string& title, CovarianceReport* report,
              Manifest* manifest) {
  const MonteCarloOptions options = MonteCarloFromFlags();
  std::vector<std::vector<DrawResult>> results;
  {
    Progress progress("draws", options.draws);
    results = RunMonteCarlo(options, [&](int done) { progress.Show(done); });
  }
  for (std::size_t m = 0; m < options.metrics.size(); ++m) {
    report->AddDraws(options.metrics[m], results[m], manifest);
  }
  report->WriteDraws(out);
  manifest->AddTiming("draws");
  RunPlotScript("plot_covariance.py", {out.string(), "--out", (out / "covariance").string(),
                                       "--title", title + ", " + FLAGS_sensor + " sensor"});
  manifest->AddTiming("figures");
}

void CheckFlags() {
  CheckPairFlags(MetricsFromFlags(), false);
  CheckFilterFlags();
  MonteCarloFromFlags();
  RequireFlag(FLAGS_length_scale_m > 0 && FLAGS_length_scale_m <= 1e6, "length_scale_m",
              Number(FLAGS_length_scale_m), "a positive length of at most 1e6 m");
}

void Covariance() {
  CheckFlags();
  const std::vector<std::string> metrics = MetricsFromFlags();
  const std::filesystem::path out = OutputFolder();
  Manifest manifest(AppName());
  RecordFlags(&manifest);
  CovarianceReport report(CovarianceFromFlags(), FLAGS_length_scale_m);
  std::string title;
  {
    ScanPair pair = ReadPair(&manifest);
    title = pair.title;
    const SE3d T_initial = InitialPose(pair, &manifest);
    const PreparedPair scans = PrepareFromFlags(metrics, &pair, &manifest);
    const ObjectiveSet set(FilterFromFlags(scans, pair, &manifest), metrics,
                           ObjectiveSetFromFlags());
    for (const Objective& objective : set.objectives()) {
      report.AddPair(objective, T_initial, ThreadsFromFlags(), &manifest);
    }
  }
  // Those of an earlier run with draws must not stand beside this run's.
  for (const char* name :
       {"draws.csv", "calibration.csv", "bias.csv", "covariance.svg", "covariance.png"}) {
    std::filesystem::remove(out / name);
  }
  report.WritePair(out);
  manifest.AddTiming("pair");
  const int draws = DrawsFromFlags();
  if (draws > 0) {
    RunDraws(out, title, &report, &manifest);
  }
  manifest.Write(out / "manifest.json");
  std::cout << "\ntime: " << manifest.TimingsText() << '\n';
  std::cout << "written: " << (out / "covariance.csv").string()
            << ", directions.csv, verdicts.csv, "
            << (draws > 0 ? "draws.csv, calibration.csv, bias.csv, covariance.svg, covariance.png, "
                          : "")
            << "manifest.json\n";
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(
      argc, argv,
      "says how sure a registration is: covariances at the solution, directions that degenerate, "
      "and, on simulated scenes, whether the covariances are right (NEES over Monte-Carlo draws).",
      icpscape::Covariance);
}
