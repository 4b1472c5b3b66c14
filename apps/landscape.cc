// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <string>
#include <vector>

#include "apps/flags/curve.h"
#include "apps/flags/minimizer.h"
#include "apps/flags/objective.h"
#include "apps/flags/pair.h"
#include "apps/flags/pair_filters.h"
#include "apps/reports/curves.h"
#include "apps/reports/ground_truth_check.h"
#include "apps/reports/iterates.h"
#include "apps/reports/registration.h"
#include "apps/run/app.h"
#include "apps/run/progress.h"
#include "apps/run/run.h"

DEFINE_string(reference, "ground_truth",
              "Reference, the pose at u = 1: ground_truth, or refined from it by point-to-plane.");
DEFINE_bool(iterates, false,
            "Also minimises each metric from --initial, and draws the iterates at their nearest u "
            "with their distance from the path.");
static const icpscape::FlagMark iterates_mark(&FLAGS_iterates, icpscape::kShown);

namespace icpscape {
namespace {

void CheckFlags() {
  CheckPairFlags(MetricsFromFlags(), true);
  CheckFilterFlags();
  FeaturesFromFlags();
  ObjectiveSetFromFlags();
  CurveFromFlags();
  PathKindFromFlags();
  ColumnFromFlags();
  RequireFlag(FLAGS_reference == "ground_truth" || FLAGS_reference == "refined", "reference",
              FLAGS_reference, "ground_truth or refined");
  if (FLAGS_iterates) {
    MinimizerFromFlags();
    CheckCurveOfIterates();
  } else {
    RefuseMinimizerFlags("--iterates with it");
  }
}

// Prints how far point-to-plane moves from the ground truth, and returns the pose for u = 1.
SE3d ReferencePose(const ScanPair& pair, const PreparedPair& scans, Manifest* manifest) {
  const bool is_refined = FLAGS_reference == "refined";
  ReportDisplacement(
      "motion", "motion",
      MotionOfSensor(scans.source.cloud(), scans.target.cloud(), *pair.T_ground_truth), manifest);
  const auto check = ReportGroundTruthCheck(pair, scans, is_refined, ThreadsFromFlags(), manifest);
  return is_refined ? check->T_refined : *pair.T_ground_truth;
}

void Draw(const std::string& scans, Run* run) {
  const std::string column = ColumnFromFlags().name;
  const unsigned without =
      FLAGS_iterates || column == "cost" ? 0U : static_cast<unsigned>(kCostOnly);
  const std::string table = (run->folder() / "curves.csv").string();
  const std::string title = TitleWithFlags(scans + "\n" + AssociationText(), without);
  std::vector<std::string> arguments = {table, "--column", column, "--title", title};
  if (!FLAGS_iterates) {
    run->Draw("plot_curves.py", arguments, "landscape");
    return;
  }
  const std::string iterates = (run->folder() / "iterates.csv").string();
  arguments.insert(arguments.end(), {"--iterates", iterates});
  run->Draw("plot_curves.py", arguments, "landscape");
  run->Draw("plot_iterates.py", {iterates, "--column", column, "--title", TitleWithFlags(scans)},
            "iterates");
}

void Landscape() {
  CheckFlags();
  const std::vector<std::string> metrics = MetricsFromFlags();
  const CurveOptions options = CurveFromFlags();
  Run run;
  Manifest* const manifest = run.manifest();
  ScanPair pair = ReadPair(manifest);
  const SE3d T_initial = InitialPose(pair, manifest);
  const PreparedPair scans = PrepareFromFlags(metrics, &pair, manifest);
  const SE3d T_reference = ReferencePose(pair, scans, manifest);
  const ObjectiveSet set(FilterFromFlags(scans, pair, manifest), metrics, ObjectiveSetFromFlags());
  const Path path(T_initial, T_reference, PathKindFromFlags(), scans.source.cloud().sensor);
  std::vector<Curve> curves;
  {
    Progress progress("poses", options.samples);
    curves =
        EvaluateCurves(set.objectives(), path, options, [&](int done) { progress.Show(done); });
  }
  manifest->AddTiming("landscape");
  ReportMinima(curves, ColumnFromFlags(), (T_reference.t() - T_initial.t()).norm(), manifest);
  WriteCurves(curves, &run);
  if (FLAGS_iterates) {
    const PathSection section = {path, options.u_min, options.u_max};
    const auto iterates = MinimizeEach(set.objectives(), T_initial, MinimizerFromFlags());
    ReportEnds(iterates, section, manifest);
    WriteIterates(iterates, section, pair.origins, &run);
    manifest->AddTiming("iterates");
  }
  Draw(pair.title, &run);
  manifest->AddTiming("figures");
  run.Finish();
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv,
                          "draws the objective functions of ICP along a path of poses from the "
                          "start (u = 0) to the true motion (u = 1): the open loop.",
                          icpscape::Landscape);
}
