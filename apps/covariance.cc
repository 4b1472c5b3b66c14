// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "apps/flags/covariance.h"
#include "apps/flags/monte_carlo.h"
#include "apps/flags/objective.h"
#include "apps/flags/pair.h"
#include "apps/flags/pair_filters.h"
#include "apps/flags/verdict.h"
#include "apps/reports/covariance.h"
#include "apps/reports/verdict.h"
#include "apps/run/app.h"
#include "apps/run/progress.h"
#include "apps/run/run.h"

namespace icpscape {
namespace {

// The report on the pair itself; returns its title.
std::string ReportPair(const std::vector<std::string>& metrics, CovarianceReport* report,
                       std::vector<NamedVerdict>* verdicts, Run* run) {
  const CovarianceOptions options = CovarianceFromFlags();
  Manifest* const manifest = run->manifest();
  ScanPair pair = ReadPair(manifest);
  const SE3d T_initial = InitialPose(pair, manifest);
  const PreparedPair scans = PrepareFromFlags(metrics, &pair, manifest);
  const ObjectiveSet set(FilterFromFlags(scans, pair, manifest), metrics, ObjectiveSetFromFlags());
  MinimizerOptions minimizer = PreciseMinimizer();
  minimizer.threads = ThreadsFromFlags();
  VerdictOptions judge = VerdictFromFlags(minimizer);
  judge.cluster_m = options.cluster_m;
  for (const Objective& objective : set.objectives()) {
    const RegistrationUncertainty found = RegisterWithUncertainty(
        objective, T_initial, options, LengthScaleFromFlags(), ThreadsFromFlags());
    verdicts->emplace_back(objective.metric().name,
                           JudgePose(objective, found.registration, judge));
    report->AddPair(verdicts->back(), found, options.cluster_m, manifest);
  }
  WriteVerdicts(*verdicts, run);
  report->WritePair(run);
  manifest->AddTiming("pair");
  return pair.title;
}

void ReportDraws(const MonteCarloOptions& options, const std::string& title,
                 CovarianceReport* report, Run* run) {
  std::vector<std::vector<DrawResult>> results;
  {
    Progress progress("draws", options.draws);
    results = RunMonteCarlo(options, [&](int done) { progress.Show(done); });
  }
  for (std::size_t m = 0; m < options.metrics.size(); ++m) {
    report->AddDraws(options.metrics[m], results[m], run->manifest());
  }
  report->WriteDraws(run);
  run->manifest()->AddTiming("draws");
  const std::string sensor =
      options.sensor == Sensor::kFixed ? "fixed sensor" : "sensor redrawn in every draw";
  run->Draw("plot_covariance.py",
            {run->folder().string(), "--title", TitleWithFlags(title + ", " + sensor)},
            "covariance");
  run->manifest()->AddTiming("figures");
}

void Covariance() {
  const std::vector<std::string> metrics = MetricsFromFlags();
  CheckPairFlags(metrics, false);
  CheckFilterFlags();
  LengthScaleFromFlags();
  VerdictFromFlags(PreciseMinimizer());
  AcceptedFromFlags();
  const MonteCarloOptions draws = MonteCarloFromFlags();
  Run run;
  CovarianceReport report;
  std::vector<NamedVerdict> verdicts;
  const std::string title = ReportPair(metrics, &report, &verdicts, &run);
  if (draws.draws > 0) {
    ReportDraws(draws, title, &report, &run);
  }
  run.Finish();
  RequireAccepted(verdicts, AcceptedFromFlags());
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(
      argc, argv,
      "says how sure a registration is: covariances at the solution, degenerate directions, and, "
      "on simulated scenes, whether the covariances are right (NEES over Monte-Carlo draws).",
      icpscape::Covariance);
}
