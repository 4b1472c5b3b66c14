// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/flags/lidar.h"
#include "apps/flags/paper.h"
#include "apps/reports/paper_figures.h"
#include "apps/reports/registration.h"
#include "apps/run/app.h"
#include "apps/run/progress.h"
#include "apps/run/run.h"
#include "apps/run/run_flags.h"
#include "icpscape/io/sequences.h"
#include "icpscape/simulation/simulated_sequence.h"

namespace icpscape {
namespace {

bool FromKitti() { return !PaperScansFromFlags().empty(); }

std::string TitleOf(const Figure& figure) {
  return FromKitti()
             ? "KITTI " + figure.sequence + ", scan " + std::to_string(FrameFromFlags(figure))
             : "simulated " + figure.scene + ", seed " + std::to_string(SeedFromFlags());
}

// The scan of the figure and the one before it.
ScanPair ReadPair(const Figure& figure, int threads, Manifest* manifest) {
  if (!FromKitti()) {
    return SimulatePair(figure.scene, SeedFromFlags(), LidarFromFlags(), threads);
  }
  const ScanSequence sequence = OpenKittiSequence(PaperScansFromFlags(), figure.sequence);
  for (const std::filesystem::path& input : sequence.inputs) {
    manifest->AddInput(input);
  }
  const int frame = FrameFromFlags(figure);
  return sequence.Pair(frame, frame - 1, [&](const char*, const Scan& scan) {
    manifest->AddInput(scan.file);
    DroppedPoints dropped;
    return scan.read(&dropped);
  });
}

// Evaluates what the figures of one scene draw, over one pair.
void EvaluateScene(const std::vector<Figure>& figures, const CurveOptions& options,
                   std::map<std::string, PaperCurve>* drawn, ClaimInputs* inputs,
                   Manifest* manifest) {
  const Figure& first = figures.front();
  ScanPair pair = ReadPair(first, options.threads, manifest);
  const SE3d T_ground_truth = pair.T_ground_truth.value();
  const SE3d T_predicted = pair.T_predicted.value();
  const PreparedPair scans =
      PrepareForPaper(std::move(pair.source), std::move(pair.target), options.threads);
  std::cout << TitleOf(first) << ": source " << scans.source.cloud().size() << " points ("
            << scans.source.features()->num_edge << " edges), target "
            << scans.target.cloud().size() << " points\n";
  const PointCloud& source = scans.source.cloud();
  ReportDisplacement("  motion", "motion_" + first.scene,
                     MotionOfSensor(source, scans.target.cloud(), T_ground_truth), manifest);
  ReportDisplacement("  predicted pose, off", "predicted_off_" + first.scene,
                     DisplacementAt(CentroidOf(source), T_ground_truth.Inverse() * T_predicted),
                     manifest);
  std::vector<FigureCurve> curves;
  std::set<Variant> variants;
  for (const Figure& figure : figures) {
    inputs->motions[figure.name] = T_ground_truth;
    for (const FigureCurve& curve : figure.curves) {
      curves.push_back(curve);
      variants.insert(curve.variant);
    }
  }
  Progress progress("poses of " + first.scene, options.samples * static_cast<int>(variants.size()));
  for (auto& [file, curve] : EvaluatePaperCurves(scans, T_ground_truth, T_predicted, curves,
                                                 options, [&](int done) { progress.Show(done); })) {
    inputs->curves[file] = curve.curve;
    (*drawn)[file] = std::move(curve);
  }
  manifest->AddTiming(first.scene);
}

void PaperFiguresMain() {
  const CurveOptions options = PaperCurveFromFlags();
  LidarFromFlags();
  SeedFromFlags();
  const std::vector<Figure> figures = FiguresFromFlags();
  Run run;
  std::map<std::string, std::vector<Figure>> by_scene;
  std::map<std::string, std::string> titles;
  for (const Figure& figure : figures) {
    by_scene[figure.scene].push_back(figure);
    titles[figure.name] = TitleWithFlags(TitleOf(figure));
  }
  std::map<std::string, PaperCurve> drawn;
  ClaimInputs inputs;
  std::set<std::string> done;
  for (const Figure& figure : figures) {
    if (done.insert(figure.scene).second) {
      EvaluateScene(by_scene[figure.scene], options, &drawn, &inputs, run.manifest());
    }
  }
  WritePaperTables(figures, titles, drawn, &run);
  ReportClaims(EvaluateClaims(inputs), PaperSourceText(), &run);
  run.Draw("plot_paper_figures.py", {run.folder().string()}, "");
  run.manifest()->AddTiming("figures");
  run.Finish();
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv,
                          "draws the paper's six result figures and checks every claim about them.",
                          icpscape::PaperFiguresMain);
}
