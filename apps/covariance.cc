// SPDX-License-Identifier: BSD-3-Clause
#include "src/covariance/covariance.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>

#include "apps/app.h"
#include "apps/lidar_flags.h"
#include "apps/objective_flags.h"
#include "apps/pair_filters.h"
#include "apps/pair_flags.h"
#include "src/common/error.h"
#include "src/common/text.h"
#include "src/covariance/degeneracy.h"
#include "src/covariance/monte_carlo.h"
#include "src/io/output.h"

DECLARE_string(scene);
DECLARE_int32(normal_neighbors);
DECLARE_double(normal_radius_m);

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

constexpr double kMillidegrees = 1000 * 180 / M_PI;
constexpr std::array<const char*, 6> kComponents = {"rx", "ry", "rz", "tx", "ty", "tz"};
constexpr std::array<const char*, 6> kUnits = {"rad", "rad", "rad", "m", "m", "m"};

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
    RequireFlag(FLAGS_draws == 0 || is_default("draws"), "draws", std::to_string(FLAGS_draws),
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
  options.normals.num_neighbors = FLAGS_normal_neighbors;
  options.normals.radius_m = FLAGS_normal_radius_m;
  options.features = FeaturesFromFlags();
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

void AppendComponents(const std::string& prefix, bool units, std::vector<std::string>* columns) {
  for (std::size_t i = 0; i < 6; ++i) {
    columns->push_back(prefix + kComponents[i] + (units ? std::string("_") + kUnits[i] : ""));
  }
}
void AppendCovarianceColumns(std::vector<std::string>* columns) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i; j < 6; ++j) {
      columns->push_back(std::string("cov_") + kComponents[i] + "_" + kComponents[j] + "_" +
                         kUnits[i] + "_" + kUnits[j]);
    }
  }
}
void AppendNumbers(const Vec6& values, std::vector<std::string>* row) {
  for (const double value : values) {
    row->push_back(Number(value));
  }
}
void AppendUpperTriangle(const Mat6& matrix, std::vector<std::string>* row) {
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      row->push_back(Number(matrix(i, j)));
    }
  }
}

// In millidegrees and millimetres.
void PrintDeviations(const char* name, const Vec6& deviation) {
  std::printf("  %-19s", name);
  for (int i = 0; i < 6; ++i) {
    std::printf(" %8.3f", deviation[i] * (i < 3 ? kMillidegrees : 1000));
  }
  std::printf("\n");
}

// The tables of the report on one pair.
struct PairTables {
  Table covariance = MakeCovariance();
  Table directions = MakeDirections();
  Table verdicts = MakeVerdicts();

  static Table MakeCovariance() {
    std::vector<std::string> columns = {"metric", "estimator"};
    AppendComponents("sd_", true, &columns);
    AppendCovarianceColumns(&columns);
    return Table(columns);
  }
  static Table MakeDirections() {
    std::vector<std::string> columns = {"metric", "length_scale_m", "eigenvalue"};
    AppendComponents("direction_", false, &columns);
    return Table(columns);
  }
  static Table MakeVerdicts() {
    std::vector<std::string> columns = {"metric", "rule",      "source",
                                        "value",  "threshold", "localizability"};
    AppendComponents("direction_", false, &columns);
    return Table(columns);
  }
};

void ReportCovariances(const std::string& metric, const CovarianceSums& sums, Table* table) {
  std::printf("standard deviations   rx (mdeg)       ry       rz  tx (mm)       ty       tz\n");
  const CovarianceOptions options = CovarianceFromFlags();
  const bool determined = EstimateCovariance(Estimator::kGaussNewton, sums, options).has_value();
  for (const Estimator estimator : AllEstimators()) {
    const std::optional<Mat6> covariance = EstimateCovariance(estimator, sums, options);
    const Mat6 values =
        covariance ? *covariance : Mat6::Constant(std::numeric_limits<double>::quiet_NaN());
    const Vec6 deviation = values.diagonal().cwiseSqrt();
    if (covariance) {
      PrintDeviations(EstimatorName(estimator), deviation);
    } else {
      const char* reason = "there is too little to estimate it from.";
      if (!determined) {
        reason = "the pairs do not determine all six degrees of freedom.";
      } else if (estimator == Estimator::kCensiRingBias && !sums.ring_bias) {
        reason = "the points have no rings.";
      }
      std::printf("  %-19s none: %s\n", EstimatorName(estimator), reason);
    }
    std::vector<std::string> row = {metric, EstimatorName(estimator)};
    AppendNumbers(deviation, &row);
    AppendUpperTriangle(values, &row);
    table->AddRow(std::move(row));
  }
}

void ReportDirections(const std::string& metric, const Mat6& hessian, Table* table) {
  const EigenDirections eigen = EigenDirectionsOf(hessian, FLAGS_length_scale_m);
  std::printf("eigenvalues of H in [L omega; v], L = %g m:", eigen.length_scale_m);
  for (int i = 0; i < 6; ++i) {
    std::printf(" %.4g", eigen.eigenvalues[i]);
    std::vector<std::string> row = {metric, Number(eigen.length_scale_m),
                                    Number(eigen.eigenvalues[i])};
    AppendNumbers(eigen.directions.col(i), &row);
    table->AddRow(std::move(row));
  }
  std::printf("\nweakest direction: [%.2f %.2f %.2f; %.2f %.2f %.2f]\n", eigen.directions(0, 0),
              eigen.directions(1, 0), eigen.directions(2, 0), eigen.directions(3, 0),
              eigen.directions(4, 0), eigen.directions(5, 0));
}

void ReportVerdicts(const std::string& metric, const std::vector<Verdict>& verdicts, Table* table,
                    Manifest* manifest) {
  std::printf("degeneracy             degenerate  partial  weakest  degenerate where\n");
  // Six verdicts to a rule.
  for (std::size_t first = 0; first < verdicts.size(); first += 6) {
    int degenerate = 0;
    int partial = 0;
    const bool above = verdicts[first].rule == "dcreg";  // A condition number; else a strength.
    double weakest = verdicts[first].value;
    for (std::size_t i = first; i < first + 6; ++i) {
      const Verdict& verdict = verdicts[i];
      degenerate += verdict.localizability == Localizability::kNone ? 1 : 0;
      partial += verdict.localizability == Localizability::kPartial ? 1 : 0;
      weakest = above ? std::max(weakest, verdict.value) : std::min(weakest, verdict.value);
      std::vector<std::string> row = {metric,
                                      verdict.rule,
                                      verdict.source,
                                      Number(verdict.value),
                                      Number(verdict.threshold),
                                      LocalizabilityName(verdict.localizability)};
      AppendNumbers(verdict.direction, &row);
      table->AddRow(std::move(row));
    }
    const Verdict& verdict = verdicts[first];
    std::printf("  %-19s %8d of 6 %7d %9.4g  %s %g\n", verdict.rule.c_str(), degenerate, partial,
                weakest, above ? "above" : "below", verdict.threshold);
    manifest->SetResult("degenerate_" + metric + "_" + verdict.rule, degenerate);
  }
}

// Registers the pair and says how sure that is.
void ReportPair(const Objective& objective, const SE3d& T_initial, PairTables* tables,
                Manifest* manifest) {
  MinimizerOptions options = PreciseMinimizer();
  options.threads = ThreadsFromFlags();
  const MinimizerSummary summary = Minimize(objective, T_initial, options);
  const std::string& metric = objective.metric();
  if (!summary.Usable()) {
    throw ComputationError(metric + ": " + summary.message);
  }
  const SE3d& T = summary.T_target_source();
  const Matches matches = objective.Match(T, options.threads);
  const CovarianceSums sums =
      SumForCovariance(objective, T, CovarianceFromFlags(), options.threads);
  std::printf("\n%s: %s after %zu steps; %ld pairs, %ld cubes of %g m\n", metric.c_str(),
              TerminationName(summary.termination), summary.iterates.size() - 1, sums.pairs,
              sums.clusters, FLAGS_cluster_m);
  ReportCovariances(metric, sums, &tables->covariance);
  ReportDirections(metric, sums.gauss_newton, &tables->directions);
  ReportVerdicts(metric,
                 JudgeDegeneracy(sums.gauss_newton, PlaneConstraintsOf(objective, T, matches)),
                 &tables->verdicts, manifest);
  const std::string warning = CovarianceWarning(metric);
  if (!warning.empty()) {
    std::printf("warning: %s\n", warning.c_str());
    manifest->SetResult("warning_" + metric, warning);
  }
}

struct DrawTables {
  Table draws = MakeDraws();
  Table calibration = MakeCalibration();
  Table bias = Table({"metric", "component", "unit", "bias", "standard_error", "deviation"});

  static Table MakeDraws() {
    std::vector<std::string> columns = {"metric", "draw", "termination", "iterations"};
    AppendComponents("error_", true, &columns);
    return Table(columns);
  }
  static Table MakeCalibration() {
    std::vector<std::string> columns = {"metric",          "estimator",        "draws",
                                        "nees_about_mean", "mean_lower_95",    "mean_upper_95",
                                        "overconfidence",  "nees_about_truth", "truth_lower_95",
                                        "truth_upper_95"};
    AppendComponents("deviation_ratio_", false, &columns);
    AppendCovarianceColumns(&columns);
    return Table(columns);
  }
};

void AddDraws(const std::string& metric, const std::vector<DrawResult>& draws, Table* table) {
  for (std::size_t i = 0; i < draws.size(); ++i) {
    std::vector<std::string> row = {metric, std::to_string(i),
                                    TerminationName(draws[i].termination),
                                    std::to_string(draws[i].iterations)};
    AppendNumbers(draws[i].usable ? draws[i].error
                                  : Vec6(Vec6::Constant(std::numeric_limits<double>::quiet_NaN())),
                  &row);
    table->AddRow(std::move(row));
  }
}

void ReportCalibration(const std::string& metric, const Calibration& calibration,
                       DrawTables* tables, Manifest* manifest) {
  const ErrorStatistics& errors = calibration.errors;
  std::printf("\n%s, %ld draws", metric.c_str(), errors.n);
  if (calibration.failed > 0) {
    std::printf(" (%ld more have no result)", calibration.failed);
  }
  std::printf(":        rx (mdeg)       ry       rz  tx (mm)       ty       tz\n");
  PrintDeviations("bias", errors.mean);
  PrintDeviations("its standard error", errors.standard_error);
  PrintDeviations("standard deviation", errors.deviation);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    tables->bias.AddRow({metric, kComponents[i], kUnits[i], Number(errors.mean[at]),
                         Number(errors.standard_error[at]), Number(errors.deviation[at])});
  }
  std::vector<std::string> actual = {metric, "monte_carlo", std::to_string(errors.n)};
  actual.insert(actual.end(), 13, "nan");
  AppendUpperTriangle(errors.covariance, &actual);
  tables->calibration.AddRow(std::move(actual));
  std::printf("  NEES (ideally 6):    about mean  sd too small by  about truth\n");
  for (const EstimatorCalibration& entry : calibration.estimators) {
    const char* name = EstimatorName(entry.estimator);
    if (entry.draws < 2) {
      std::printf("  %-19s %11s\n", name, "none");
      continue;
    }
    const Nees& mean = entry.about_mean;
    const Nees& truth = entry.about_truth;
    std::printf("  %-19s %11.2f %16.2f %12.2f\n", name, mean.mean, mean.Overconfidence(),
                truth.mean);
    std::vector<std::string> row = {metric,
                                    name,
                                    std::to_string(entry.draws),
                                    Number(mean.mean),
                                    Number(mean.lower),
                                    Number(mean.upper),
                                    Number(mean.Overconfidence()),
                                    Number(truth.mean),
                                    Number(truth.lower),
                                    Number(truth.upper)};
    AppendNumbers(entry.deviation_ratio, &row);
    AppendUpperTriangle(entry.mean_covariance, &row);
    tables->calibration.AddRow(std::move(row));
    manifest->SetResult("nees_about_mean_" + metric + "_" + name, mean.mean);
    manifest->SetResult("nees_about_truth_" + metric + "_" + name, truth.mean);
  }
  const Nees& bounds = calibration.estimators.front().about_mean;
  std::printf("  95 %% of right covariances are between %.2f and %.2f about the mean\n",
              bounds.lower, bounds.upper);
}

void RunDraws(const std::filesystem::path& out, const std::string& title, Manifest* manifest) {
  const MonteCarloOptions options = MonteCarloFromFlags();
  std::vector<std::vector<DrawResult>> results;
  {
    Progress progress("draws", options.draws);
    results = RunMonteCarlo(options, [&](int done) { progress.Show(done); });
  }
  DrawTables tables;
  for (std::size_t m = 0; m < options.metrics.size(); ++m) {
    AddDraws(options.metrics[m], results[m], &tables.draws);
    ReportCalibration(options.metrics[m], Calibrate(results[m]), &tables, manifest);
  }
  tables.draws.WriteCsv(out / "draws.csv");
  tables.calibration.WriteCsv(out / "calibration.csv");
  tables.bias.WriteCsv(out / "bias.csv");
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
  PairTables tables;
  std::string title;
  {
    ScanPair pair = LoadPair(metrics, &manifest);
    title = pair.title;
    FilterPair(&pair, &manifest);
    const ObjectiveSet set(pair.source, pair.target, pair.features, metrics,
                           ObjectiveSetFromFlags());
    for (const Objective& objective : set.objectives()) {
      ReportPair(objective, pair.T_initial, &tables, &manifest);
    }
  }
  tables.covariance.WriteCsv(out / "covariance.csv");
  tables.directions.WriteCsv(out / "directions.csv");
  tables.verdicts.WriteCsv(out / "verdicts.csv");
  manifest.AddTiming("pair");
  const int draws = DrawsFromFlags();
  if (draws > 0) {
    RunDraws(out, title, &manifest);
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
