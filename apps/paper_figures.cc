// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/flags/lidar.h"
#include "apps/flags/paper.h"
#include "apps/flags/run.h"
#include "apps/reports/paper_figures.h"
#include "apps/reports/registration.h"
#include "apps/run/app.h"
#include "apps/run/progress.h"
#include "apps/run/run.h"
#include "src/io/kitti.h"
#include "src/simulation/scenes.h"

namespace icpscape {
namespace {

bool FromKitti() { return !PaperScansFromFlags().empty(); }

std::string TitleOf(const Figure& figure) {
  return FromKitti()
             ? "KITTI " + figure.sequence + ", scan " + std::to_string(FrameFromFlags(figure))
             : "simulated " + figure.scene + ", seed " + std::to_string(SeedFromFlags());
}

PaperPair LoadPair(const Figure& figure, int threads, Manifest* manifest) {
  PaperPair pair;
  if (FromKitti()) {
    const KittiSequence sequence(PaperScansFromFlags(), figure.sequence);
    const int frame = FrameFromFlags(figure);
    pair.T_target_source = sequence.RelativeMotion(frame - 1, frame);
    pair.T_prior = sequence.RelativeMotion(frame - 2, frame - 1);
    DroppedPoints dropped;
    pair.source = ReadVelodyne(sequence.ScanPath(frame), &dropped);
    pair.target = ReadVelodyne(sequence.ScanPath(frame - 1), &dropped);
    for (const auto& path : {sequence.PosesPath(), sequence.CalibrationPath(),
                             sequence.ScanPath(frame), sequence.ScanPath(frame - 1)}) {
      manifest->AddInput(path);
    }
  } else {
    SimulatedPair simulated =
        SimulatePair(figure.scene, SeedFromFlags(), LidarFromFlags(), threads);
    pair.source = std::move(simulated.source);
    pair.target = std::move(simulated.target);
    pair.T_target_source = simulated.T_target_source;
    pair.T_prior = simulated.T_prior;
  }
  PrepareForMetrics(threads, &pair);
  return pair;
}

// Evaluates what the figures of one scene draw, over one pair.
void EvaluateScene(const std::vector<Figure>& figures, const CurveOptions& options,
                   std::map<std::string, PaperCurve>* drawn, ClaimInputs* inputs,
                   Manifest* manifest) {
  const Figure& first = figures.front();
  const PaperPair pair = LoadPair(first, options.threads, manifest);
  std::cout << TitleOf(first) << ": source " << pair.source.size() << " points ("
            << pair.features.num_edge << " edges), target " << pair.target.size() << " points\n";
  ReportPose("  motion", "motion_" + first.scene, pair.T_target_source, manifest);
  ReportPose("  T_e, the motion of the frame before, off", "prior_off_" + first.scene,
             pair.T_target_source.Inverse() * pair.T_prior, manifest);
  std::vector<FigureCurve> curves;
  std::set<Variant> variants;
  for (const Figure& figure : figures) {
    inputs->motions[figure.name] = pair.T_target_source;
    for (const FigureCurve& curve : figure.curves) {
      curves.push_back(curve);
      variants.insert(curve.variant);
    }
  }
  Progress progress("poses of " + first.scene, options.samples * static_cast<int>(variants.size()));
  for (auto& [file, curve] :
       EvaluatePaperCurves(pair, curves, options, [&](int done) { progress.Show(done); })) {
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
