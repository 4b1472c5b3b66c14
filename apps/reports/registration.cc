// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/registration.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include "apps/reports/iterates.h"
#include "icpscape/common/text.h"
#include "icpscape/io/output.h"
#include "icpscape/io/transform.h"

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;

std::string LossScalesText(const Stage& stage) {
  std::vector<std::string> texts;
  for (const double scale : stage.loss_scales) {
    texts.push_back(Number(scale));
  }
  return texts.empty() ? "none" : Join(texts, " ");
}

// "stages: all pairs, pairs up to 1.24 m, ...": what each loop of a preset saw.
void ReportStages(const std::vector<Stage>& stages, Run* run) {
  Table csv({"stage", "first_iterate", "max_distance_m", "loss_scales"});
  std::printf("pairs of the stages:");
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Stage& stage = stages[i];
    csv.AddRow({std::to_string(i), std::to_string(stage.first_iterate),
                Number(stage.max_distance_m), LossScalesText(stage)});
    if (stage.max_distance_m > 0) {
      std::printf("%s up to %.3g m", i > 0 ? "," : "", stage.max_distance_m);
    } else {
      std::printf("%s all", i > 0 ? "," : "");
    }
  }
  std::printf("\n");
  csv.WriteCsv(run->File("stages.csv"));
  run->manifest()->SetResult("last_max_distance_m", stages.back().max_distance_m);
}

}  // namespace

void ReportDisplacement(const std::string& what, const std::string& name,
                        const Displacement& displacement, Manifest* manifest) {
  const double degrees = displacement.rad * kDegrees;
  std::printf("%s: %.4f m, %.4f deg\n", what.c_str(), displacement.m, degrees);
  manifest->SetResult(name + "_m", displacement.m);
  manifest->SetResult(name + "_deg", degrees);
}

void ReportRegistration(const std::string& name, const Registered& registered,
                        const PairOrigins& origins, Run* run) {
  const MinimizerSummary& summary = registered.summary;
  PrintIterates(summary);
  if (registered.stages.size() > 1) {
    ReportStages(registered.stages, run);
  }
  WriteIterates({{name, summary}}, std::nullopt, origins, run);
  std::printf("%s: %s\nfinal cost: %s\n", NameOf(summary.termination), summary.message.c_str(),
              Number(summary.final_cost()).c_str());
  Manifest* const manifest = run->manifest();
  manifest->SetResult("termination", NameOf(summary.termination));
  manifest->SetResult("final_cost", summary.final_cost());
  manifest->SetResult("matching_passes", summary.matching_passes);
  WriteTextFile(run->File("T_target_source.txt"),
                FormatTransform(origins.ToUser(summary.T_target_source())));
}

}  // namespace icpscape
