// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <optional>
#include <string>
#include <vector>

#include "apps/flags/joint.h"
#include "apps/flags/minimizer.h"
#include "apps/flags/objective.h"
#include "apps/flags/pair.h"
#include "apps/flags/pair_filters.h"
#include "apps/flags/preset.h"
#include "apps/flags/starts.h"
#include "apps/flags/verdict.h"
#include "apps/reports/ground_truth_check.h"
#include "apps/reports/registration.h"
#include "apps/reports/starts.h"
#include "apps/reports/verdict.h"
#include "apps/run/app.h"
#include "apps/run/run.h"
#include "icpscape/common/error.h"
#include "icpscape/io/point_files.h"

DEFINE_int32(starts, 0, "Number of random starts about the reference, for the success rate.");
static const icpscape::FlagMark starts_mark(&FLAGS_starts, icpscape::kAside);

namespace icpscape {
namespace {

void CheckFlags() {
  PresetFromFlags();
  CheckPairFlags(MetricsFromFlags(), FLAGS_starts > 0);
  CheckFilterFlags();
  FeaturesFromFlags();
  ObjectiveSetFromFlags();
  VerdictFromFlags(MinimizerFromFlags());
  AcceptedFromFlags();
  WeightsFromFlags();
  StartsFromFlags();
  RequireFlag(FLAGS_starts >= 0 && FLAGS_starts <= 1000000, "starts", std::to_string(FLAGS_starts),
              "0 to 1e6");
}

RandomStartOptions StartsOf(const MinimizerOptions& minimizer) {
  RandomStartOptions options = StartsFromFlags();
  options.count = FLAGS_starts;
  options.minimizer = minimizer;
  return options;
}

void Register() {
  CheckFlags();
  const std::vector<std::string> metrics = MetricsFromFlags();
  const MinimizerOptions options = MinimizerFromFlags();
  Run run;
  Manifest* const manifest = run.manifest();
  ScanPair pair = ReadPair(manifest);
  const SE3d T_initial = InitialPose(pair, manifest);
  const PreparedPair scans = PrepareFromFlags(metrics, &pair, manifest);
  std::optional<GroundTruthCheck> check;
  if (pair.T_ground_truth) {
    check = ReportGroundTruthCheck(pair, scans, FLAGS_starts > 0, ThreadsFromFlags(), manifest);
  }
  const Registration registration(FilterFromFlags(scans, pair, manifest), metrics,
                                  WeightsFromFlags(), ObjectiveSetFromFlags(), PresetFromFlags(),
                                  options.threads);
  const Registered registered = registration.Run(T_initial, options);
  const JointObjective& objective = registered.objective;
  const MinimizerSummary& summary = registered.summary;
  manifest->AddTiming("register");
  const std::vector<NamedVerdict> verdicts = {
      {objective.Name(), JudgePose(objective, summary, VerdictFromFlags(options))}};
  const Verdict& verdict = verdicts.front().second;
  manifest->AddTiming("verdict");
  if (!verdict.HasPose()) {
    throw ComputationError(objective.Name() + ": " + verdict.no_pose);
  }
  const SE3d& T = summary.T_target_source();
  ReportRegistration(objective.Name(), registered, pair.origins, &run);
  const PointCloud& source = scans.source.cloud();
  ReportDisplacement("motion", "motion", MotionOfSensor(source, scans.target.cloud(), T), manifest);
  PrintVerdict(verdict);
  WriteVerdicts(verdicts, &run);
  manifest->SetResult("searches_built", static_cast<double>(SearchesBuilt()));
  PointCloud aligned = source.Transformed(T);
  aligned.origin = pair.origins.target;
  WritePly(run.File("aligned.ply"), aligned);
  const auto report_off = [&](const char* what, const char* name, const SE3d& T_reference) {
    ReportDisplacement(what, name, DisplacementAt(CentroidOf(source), T_reference.Inverse() * T),
                       manifest);
  };
  if (pair.T_ground_truth) {
    report_off("off the ground truth", "off", *pair.T_ground_truth);
  }
  if (check) {
    report_off("off the refined reference", "off_refined", check->T_refined);
    if (FLAGS_starts > 0) {
      RunStarts(registration, check->T_refined, CentroidOf(source), StartsOf(options), &run);
    }
  }
  run.Draw("plot_iterates.py",
           {(run.folder() / "iterates.csv").string(), "--title", TitleWithFlags(pair.title)},
           "iterates");
  manifest->AddTiming("figures");
  run.Finish();
  RequireAccepted(verdicts, AcceptedFromFlags());
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  // landscape's default draws three metrics; here all that are named are minimised together.
  icpscape::SetFlagDefault("metrics", "point_to_plane");
  return icpscape::RunApp(argc, argv,
                          "registers two scans: minimises the objective of one metric, or the "
                          "weighted sum of several, with Ceres: the closed loop.",
                          icpscape::Register);
}
