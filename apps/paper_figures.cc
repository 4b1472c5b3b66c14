// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>

#include "apps/flags/lidar.h"
#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/common/parallel.h"
#include "src/common/text.h"
#include "src/io/kitti.h"
#include "src/io/output.h"
#include "src/io/sequences.h"
#include "src/paper/claims.h"
#include "src/paper/figures.h"
#include "src/paper/paper_curves.h"
#include "src/paper/predicates.h"
#include "src/simulation/simulated_sequence.h"

DEFINE_string(figure, "all",
              "all or one of 00_1500, 00_100, 01_320, 01_320_improved, 01_420, 01_420_octree.");
DEFINE_string(
    source, "simulated",
    "simulated: scenes driven with the motion of the paper's frames, by --seed; or kitti: "
    "the paper's own frames, which --kitti_root implies.");
DEFINE_string(kitti_root, "", "Folder of the KITTI odometry data (with sequences/ and poses/).");
DEFINE_int32(straight_frame, 1500,
             "KITTI 00 scan of figure 00_1500; 15 stands in where the paper's is not at hand.");
DEFINE_int32(turn_frame, 100,
             "KITTI 00 scan of figure 00_100; 95 stands in where the paper's is not at hand.");
DEFINE_int32(samples, 100, "Poses along the path, u from -1 to 2, both ends included.");
DEFINE_int32(threads, 0, "Threads; 0 is all of the machine. Results do not depend on it.");
DEFINE_string(out, "out", "Folder for the results.");

namespace icpscape {
namespace {

bool FromKitti() { return !FLAGS_kitti_root.empty() || FLAGS_source == "kitti"; }

int FrameOf(const Figure& figure) {
  if (figure.name == "00_1500") {
    return FLAGS_straight_frame;
  }
  return figure.name == "00_100" ? FLAGS_turn_frame : figure.frame;
}

std::string TitleOf(const Figure& figure) {
  return FromKitti() ? "KITTI " + figure.sequence + ", scan " + std::to_string(FrameOf(figure))
                     : "simulated " + figure.scene + ", seed " + std::to_string(SeedFromFlags());
}

void CheckFlags(const CurveOptions& options) {
  FiguresFromName(FLAGS_figure);
  options.Check();
  if (FLAGS_source != "simulated" && FLAGS_source != "kitti") {
    throw UsageError("--source=" + FLAGS_source + ": expected simulated or kitti.");
  }
  if (FLAGS_source == "kitti" && FLAGS_kitti_root.empty()) {
    throw UsageError("--source=kitti: expected --kitti_root=DIR with it.");
  }
  RequireFlag(FLAGS_threads >= 0 && FLAGS_threads <= 1024, "threads", std::to_string(FLAGS_threads),
              "0 (all) to 1024");
  RequireFlag(FLAGS_straight_frame >= 2, "straight_frame", std::to_string(FLAGS_straight_frame),
              "at least 2, for two scans before it");
  RequireFlag(FLAGS_turn_frame >= 2, "turn_frame", std::to_string(FLAGS_turn_frame),
              "at least 2, for two scans before it");
  LidarFromFlags();
  SeedFromFlags();
}

// Leaves out the figures whose scans are not on disk, and says so. Throws InputError where none is
// left.
std::vector<Figure> FiguresOnDisk(const std::vector<Figure>& wanted) {
  std::vector<Figure> figures;
  std::set<std::string> said;
  for (const Figure& figure : wanted) {
    std::string missing;
    for (const int frame : {FrameOf(figure) - 1, FrameOf(figure)}) {
      const std::filesystem::path scan =
          KittiFiles(FLAGS_kitti_root, figure.sequence).Scan(frame);
      if (!std::filesystem::exists(scan)) {
        missing += (missing.empty() ? "" : " and ") + scan.string();
      }
    }
    if (missing.empty()) {
      figures.push_back(figure);
    } else {
      std::cout << "figure " << figure.name << " is skipped: " << missing << " not found.\n";
    }
  }
  if (figures.empty()) {
    throw InputError(FLAGS_kitti_root +
                     ": no figure's scans are there; expected those named above.");
  }
  return figures;
}

// The scan of the figure and the one before it.
ScanPair ReadPair(const Figure& figure, int threads, Manifest* manifest) {
  if (!FromKitti()) {
    return SimulatePair(figure.scene, SeedFromFlags(), LidarFromFlags(), threads);
  }
  const ScanSequence sequence = OpenKittiSequence(FLAGS_kitti_root, figure.sequence);
  for (const std::filesystem::path& input : sequence.inputs) {
    manifest->AddInput(input);
  }
  const int frame = FrameOf(figure);
  return sequence.Pair(frame, frame - 1, [&](const char*, const Scan& scan) {
    manifest->AddInput(scan.file);
    DroppedPoints dropped;
    return scan.read(&dropped);
  });
}

// What the figures of one scene draw, over one pair.
void EvaluateScene(const std::vector<Figure>& figures, const std::string& scene,
                   const CurveOptions& options, std::map<std::string, PaperCurve>* drawn,
                   ClaimInputs* inputs, Manifest* manifest) {
  std::vector<FigureCurve> curves;
  std::set<Variant> variants;
  const Figure* first = nullptr;
  for (const Figure& figure : figures) {
    if (figure.scene == scene) {
      first = first == nullptr ? &figure : first;
      for (const FigureCurve& curve : figure.curves) {
        curves.push_back(curve);
        variants.insert(curve.variant);
      }
    }
  }
  ScanPair pair = ReadPair(*first, options.threads, manifest);
  const SE3d T_ground_truth = pair.T_ground_truth.value();
  const SE3d T_predicted = pair.T_predicted.value();
  const PreparedPair scans =
      PrepareForPaper(std::move(pair.source), std::move(pair.target), options.threads);
  std::cout << TitleOf(*first) << ": source " << scans.source.cloud().size() << " points ("
            << scans.source.features()->num_edge << " edges), target "
            << scans.target.cloud().size() << " points" << std::endl;
  const SE3d off = T_ground_truth.Inverse() * T_predicted;
  std::printf("  motion %.4f m; that of the frame before, T_e, is %.4f m and %.3f deg off\n",
              T_ground_truth.t().norm(), off.t().norm(),
              off.LogRotation().norm() * 180 / M_PI);
  manifest->SetResult("prior_off_m_" + scene, off.t().norm());
  Progress progress("poses of " + scene, options.samples * static_cast<int>(variants.size()));
  for (auto& [file, curve] :
       EvaluatePaperCurves(scans, T_ground_truth, T_predicted, curves, options, [&](int done) { progress.Show(done); })) {
    inputs->curves[file] = curve.curve;
    (*drawn)[file] = std::move(curve);
  }
  for (const Figure& figure : figures) {
    if (figure.scene == scene) {
      inputs->motions[figure.name] = T_ground_truth;
    }
  }
  manifest->AddTiming(scene);
}

void WriteTables(const std::vector<Figure>& figures, const std::map<std::string, PaperCurve>& drawn,
                 const std::filesystem::path& out) {
  Table list({"figure", "title", "file", "legend", "color", "style", "in_paper", "y_min", "y_max"});
  Table minima({"figure", "file", "metric", "argmin_u", "local_minima", "rmse", "n"});
  Table pulls({"figure", "file", "group", "n_0", "eps_0", "n_1", "eps_1"});
  for (const Figure& figure : figures) {
    std::string title = TitleOf(figure);
    title.replace(title.find(','), 1, ";");  // The tables separate by commas.
    for (const FigureCurve& curve : figure.curves) {
      const PaperCurve& found = drawn.at(curve.file);
      Table table({"u", "rmse"});
      for (const CurvePoint& point : found.curve.points) {
        table.AddRow({Number(point.u), Number(point.rmse)});
      }
      table.WritePgfplots(out / "data" / (curve.file + ".txt"));
      list.AddRow({figure.name, title, curve.file, curve.legend, curve.color, curve.style,
                   curve.in_paper ? "1" : "0", figure.y_range ? Number(figure.y_range->first) : "",
                   figure.y_range ? Number(figure.y_range->second) : ""});
      const CurvePoint& least = found.curve.Minimum();
      minima.AddRow({figure.name, curve.file, curve.metric, Number(least.u),
                     std::to_string(LocalMinima(found.curve).size()), Number(least.rmse),
                     Number(least.n)});
      for (const Pull& pull : found.pulls) {
        pulls.AddRow({figure.name, curve.file, pull.group, Number(pull.n_0), Number(pull.epsilon_0),
                      Number(pull.n_1), Number(pull.epsilon_1)});
      }
    }
    WriteTextFile(out / (figure.name + ".tex"), StandaloneLatex(figure));
  }
  list.WriteCsv(out / "figures.csv");
  minima.WriteCsv(out / "minima.csv");
  pulls.WriteCsv(out / "pulls.csv");
}

void WriteClaims(const std::vector<Claim>& claims, const std::string& source,
                 const std::filesystem::path& out, Manifest* manifest) {
  Table table({"id", "claim", "measured", "outcome"});
  for (const Claim& claim : claims) {
    table.AddRow({claim.id, claim.statement, claim.measured, OutcomeName(claim.outcome)});
    manifest->SetResult("claim_" + claim.id, OutcomeName(claim.outcome));
    if (claim.outcome != Claim::Outcome::kNotDrawn) {
      std::cout << claim.id << ": " << OutcomeName(claim.outcome) << ": " << claim.statement << " ["
                << claim.measured << "]\n";
    }
  }
  table.WriteCsv(out / "claims.csv");
  WriteTextFile(out / "claims.md", ClaimsMarkdown(claims, source));
}

// --out, without what an earlier run drew: its figures must not stand beside this run's claims.
std::filesystem::path PrepareOut() {
  RequireFlag(!FLAGS_out.empty(), "out", FLAGS_out, "a folder");
  const std::filesystem::path out = FLAGS_out;
  PrepareOutputFolder(out / "data");
  std::filesystem::remove(out / "manifest.json");
  for (const Figure& figure : PaperFigures()) {
    for (const char* extension : {".tex", ".svg", ".png"}) {
      std::filesystem::remove(out / (figure.name + extension));
    }
    for (const FigureCurve& curve : figure.curves) {
      std::filesystem::remove(out / "data" / (curve.file + ".txt"));
    }
  }
  return out;
}

void PaperFiguresMain() {
  CurveOptions options;
  options.samples = FLAGS_samples;
  options.threads = FLAGS_threads > 0 ? FLAGS_threads : HardwareThreads();
  CheckFlags(options);
  const std::filesystem::path out = PrepareOut();
  Manifest manifest(AppName());
  RecordFlags(&manifest);
  std::vector<Figure> figures = FiguresFromName(FLAGS_figure);
  if (FromKitti()) {
    figures = FiguresOnDisk(figures);
  }

  std::map<std::string, PaperCurve> drawn;
  ClaimInputs inputs;
  std::set<std::string> scenes;
  for (const Figure& figure : figures) {
    if (scenes.insert(figure.scene).second) {
      EvaluateScene(figures, figure.scene, options, &drawn, &inputs, &manifest);
    }
  }
  WriteTables(figures, drawn, out);
  WriteClaims(EvaluateClaims(inputs),
              FromKitti()
                  ? "KITTI's scans (straight street 00/" + std::to_string(FLAGS_straight_frame) +
                        ", turn 00/" + std::to_string(FLAGS_turn_frame) + ")"
                  : "the simulated scenes, seed " + std::to_string(SeedFromFlags()),
              out, &manifest);
  RunPlotScript("plot_paper_figures.py", {out.string()});
  manifest.AddTiming("figures");
  manifest.Write(out / "manifest.json");
  std::cout << "written: " << (out / "claims.md").string()
            << ", claims.csv, minima.csv, pulls.csv, data/, and .tex, .svg, .png of "
            << figures.size() << " figures\n";
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv,
                          "draws the paper's six result figures and checks every claim about them.",
                          icpscape::PaperFiguresMain);
}
