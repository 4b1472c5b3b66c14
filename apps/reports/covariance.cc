// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/covariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "icpscape/common/text.h"

namespace icpscape {
namespace {

constexpr double kMillidegrees = 1000 * 180 / M_PI;
constexpr std::array<const char*, 6> kComponents = {"rx", "ry", "rz", "tx", "ty", "tz"};
constexpr std::array<const char*, 6> kUnits = {"rad", "rad", "rad", "m", "m", "m"};

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
    const double value = deviation[i] * (i < 3 ? kMillidegrees : 1000);
    std::printf(" %8s", std::isnan(value) ? "none" : Fixed(value, 3).c_str());
  }
  std::printf("\n");
}

Table CovarianceTable() {
  std::vector<std::string> columns = {"metric", "estimator"};
  AppendComponents("sd_", true, &columns);
  AppendCovarianceColumns(&columns);
  return Table(columns);
}

Table DirectionTable() {
  std::vector<std::string> columns = {"metric", "length_scale_m", "eigenvalue"};
  AppendComponents("direction_", false, &columns);
  return Table(columns);
}

Table JudgementTable() {
  std::vector<std::string> columns = {"metric", "rule",      "source",
                                      "value",  "threshold", "localizability"};
  AppendComponents("direction_", false, &columns);
  return Table(columns);
}

Table DrawTable() {
  std::vector<std::string> columns = {"metric", "draw", "termination", "iterations"};
  AppendComponents("error_", true, &columns);
  return Table(columns);
}

Table CalibrationTable() {
  std::vector<std::string> columns = {"metric",          "estimator",        "draws",
                                      "nees_about_mean", "mean_lower_95",    "mean_upper_95",
                                      "overconfidence",  "nees_about_truth", "truth_lower_95",
                                      "truth_upper_95"};
  AppendComponents("deviation_ratio_", false, &columns);
  AppendCovarianceColumns(&columns);
  return Table(columns);
}

void ReportCovariances(const NamedVerdict& verdict, const std::vector<EstimatedCovariance>& all,
                       Table* table) {
  std::printf("standard deviations   rx (mdeg)       ry       rz  tx (mm)       ty       tz\n");
  for (const EstimatedCovariance& entry : all) {
    const char* name = NameOf(entry.estimator);
    const Mat6 values =
        entry.covariance.value_or(Mat6(Mat6::Constant(std::numeric_limits<double>::quiet_NaN())));
    // Along an undetermined axis no estimator knows a deviation, whatever it says.
    const Vec6 deviation = verdict.second.deviation.array().isNaN().select(
        std::numeric_limits<double>::quiet_NaN(), values.diagonal().cwiseSqrt());
    if (entry.covariance) {
      PrintDeviations(name, deviation);
    } else {
      std::printf("  %-19s none: %s.\n", name, entry.reason.c_str());
    }
    std::vector<std::string> row = {verdict.first, name};
    AppendNumbers(deviation, &row);
    AppendUpperTriangle(values, &row);
    table->AddRow(std::move(row));
  }
}

void ReportDirections(const std::string& metric, const EigenDirections& eigen, Table* table) {
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

void ReportJudgements(const std::string& metric, const std::vector<Judgement>& judgements,
                      Table* table, Manifest* manifest) {
  std::printf("degeneracy             degenerate  partial  weakest  degenerate where\n");
  // Six judgements to a rule.
  for (std::size_t first = 0; first < judgements.size(); first += 6) {
    int degenerate = 0;
    int partial = 0;
    const bool above = judgements[first].rule == "dcreg";  // A condition number; else a strength.
    double weakest = judgements[first].value;
    for (std::size_t i = first; i < first + 6; ++i) {
      const Judgement& judgement = judgements[i];
      degenerate += judgement.localizability == Localizability::kNone ? 1 : 0;
      partial += judgement.localizability == Localizability::kPartial ? 1 : 0;
      weakest = above ? std::max(weakest, judgement.value) : std::min(weakest, judgement.value);
      std::vector<std::string> row = {metric,
                                      judgement.rule,
                                      judgement.source,
                                      Number(judgement.value),
                                      Number(judgement.threshold),
                                      NameOf(judgement.localizability)};
      AppendNumbers(judgement.direction, &row);
      table->AddRow(std::move(row));
    }
    const Judgement& judgement = judgements[first];
    std::printf("  %-19s %8d of 6 %7d %9.4g  %s %g\n", judgement.rule.c_str(), degenerate, partial,
                weakest, above ? "above" : "below", judgement.threshold);
    manifest->SetResult("degenerate_" + metric + "_" + judgement.rule, degenerate);
  }
}

void ListDraws(const std::string& metric, const std::vector<DrawResult>& draws, Table* table) {
  for (std::size_t i = 0; i < draws.size(); ++i) {
    std::vector<std::string> row = {metric, std::to_string(i), NameOf(draws[i].termination),
                                    std::to_string(draws[i].iterations)};
    AppendNumbers(draws[i].usable ? draws[i].error
                                  : Vec6(Vec6::Constant(std::numeric_limits<double>::quiet_NaN())),
                  &row);
    table->AddRow(std::move(row));
  }
}

}  // namespace

CovarianceReport::CovarianceReport()
    : covariances_(CovarianceTable()),
      directions_(DirectionTable()),
      judgements_(JudgementTable()),
      draws_(DrawTable()),
      calibration_(CalibrationTable()) {}

void CovarianceReport::AddPair(const NamedVerdict& verdict, const RegistrationUncertainty& result,
                               double cluster_m, Manifest* manifest) {
  const std::string& metric = verdict.first;
  const MinimizerSummary& summary = result.registration;
  std::printf("\n%s: %s after %zu steps; %ld pairs, %ld cubes of %g m\n", metric.c_str(),
              NameOf(summary.termination), summary.iterates.size() - 1, result.sums.pairs,
              result.sums.clusters, cluster_m);
  PrintVerdict(verdict.second);
  ReportCovariances(verdict, result.covariances, &covariances_);
  ReportDirections(metric, result.directions, &directions_);
  ReportJudgements(metric, result.judgements, &judgements_, manifest);
  const std::string warning = CovarianceWarning(metric);
  if (!warning.empty()) {
    std::printf("warning: %s\n", warning.c_str());
    manifest->SetResult("warning_" + metric, warning);
  }
}

void CovarianceReport::AddDraws(const std::string& metric, const std::vector<DrawResult>& draws,
                                Manifest* manifest) {
  ListDraws(metric, draws, &draws_);
  const Calibration calibration = Calibrate(draws);
  const ErrorStatistics& errors = calibration.errors;
  std::printf("\n%s, %ld draws", metric.c_str(), errors.n);
  if (calibration.failed > 0) {
    std::printf(" (%ld more have no result)", calibration.failed);
  }
  std::printf(":        rx (mdeg)       ry       rz  tx (mm)       ty       tz\n");
  if (calibration.unconverged > 0) {
    std::printf(
        "warning: %ld of them ended at the limit of iterations, before the gradient vanished: "
        "bias and NEES are not those of a minimum\n",
        calibration.unconverged);
  }
  manifest->SetResult("unconverged_" + metric, static_cast<double>(calibration.unconverged));
  PrintDeviations("bias", errors.mean);
  PrintDeviations("its standard error", errors.standard_error);
  PrintDeviations("standard deviation", errors.deviation);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    bias_.AddRow({metric, kComponents[i], kUnits[i], Number(errors.mean[at]),
                  Number(errors.standard_error[at]), Number(errors.deviation[at])});
  }
  std::vector<std::string> actual = {metric, "monte_carlo", std::to_string(errors.n)};
  actual.insert(actual.end(), 13, "nan");
  AppendUpperTriangle(errors.covariance, &actual);
  calibration_.AddRow(std::move(actual));
  std::printf(
      "  NEES (ideally 6):    about mean  sd too small by  about truth   draws  95 %% bounds\n");
  for (const EstimatorCalibration& entry : calibration.estimators) {
    const char* name = NameOf(entry.estimator);
    if (entry.draws < 2) {
      std::printf("  %-19s %11s %37ld\n", name, "none", entry.draws);
      continue;
    }
    const Nees& mean = entry.about_mean;
    const Nees& truth = entry.about_truth;
    std::printf("  %-19s %11.2f %16.2f %12.2f %7ld  %.2f to %.2f\n", name, mean.mean,
                mean.Overconfidence(), truth.mean, entry.draws, mean.lower, mean.upper);
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
    calibration_.AddRow(std::move(row));
    manifest->SetResult("nees_about_mean_" + metric + "_" + name, mean.mean);
    manifest->SetResult("nees_about_truth_" + metric + "_" + name, truth.mean);
  }
  std::printf(
      "  (over the draws that have that covariance; bounds: 95 %% of the NEES about the mean lie\n"
      "  between them if the covariance is right)\n");
}

void CovarianceReport::WritePair(Run* run) const {
  covariances_.WriteCsv(run->File("covariance.csv"));
  directions_.WriteCsv(run->File("directions.csv"));
  judgements_.WriteCsv(run->File("degeneracy.csv"));
}

void CovarianceReport::WriteDraws(Run* run) const {
  draws_.WriteCsv(run->File("draws.csv"));
  calibration_.WriteCsv(run->File("calibration.csv"));
  bias_.WriteCsv(run->File("bias.csv"));
}

}  // namespace icpscape
