// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <iostream>
#include <string>
#include <vector>

#include "apps/reports/aligned_table.h"
#include "apps/run/app.h"
#include "icpscape/residuals/registry.h"

DEFINE_bool(markdown, false, "Print the tables as Markdown, as in docs/metrics.md.");

namespace icpscape {
namespace {

std::string NeedsColumn(unsigned needs) {
  return needs == kPointsOnly ? "points" : "points, " + NeedsText(needs);
}

// What the paper's eps sums, with r the residual.
std::string EpsilonText(Epsilon epsilon) {
  switch (epsilon) {
    case Epsilon::kSquared:
      return "|r|^2";
    case Epsilon::kNorm:
      return "|r|";
    case Epsilon::kSoftNorm:
      return "sqrt(1 + |r|^2) - 1";
  }
  return "";
}

// What else the chain is made of, by the stages of the paper's figure 1 and table 1.
struct Variant {
  const char* stage;
  const char* name;
  const char* flag;
  const char* source;
};
constexpr Variant kVariants[] = {
    {"data filtering", "voxel grid", "--voxel_m", "not in the paper"},
    {"data filtering", "artificial blind spot", "--artificial_blind_spot_m", "paper sec. 4.2"},
    {"data filtering", "ego blind spot filter", "--ego_filter_m", "paper sec. 2.6"},
    {"data filtering", "Octree Correspondence Filter", "--octree_voxel_m", "paper sec. 2.7"},
    {"data filtering", "edge and planar points", "--smoothness", "paper sec. 2.4, LOAM"},
    {"correspondence", "closest point", "(default)", "Besl & McKay 1992"},
    {"correspondence", "line or patch of neighbours", "--fit_neighbors", "paper sec. 2.4, LOAM"},
    {"correspondence", "reciprocal", "--reciprocal", "paper sec. 2.5"},
    {"correspondence", "distance gate", "--max_distance_m", "not in the paper"},
    {"correspondence", "normal angle", "--max_normal_angle_deg", "not in the paper"},
    {"correspondence", "median distance", "--max_median_factor", "not in the paper"},
    {"correspondence", "trimmed", "--kept_fraction", "not in the paper"},
    {"correspondence", "region split", "--region_size_m", "Bengtsson & Baerveldt 1999"},
    {"objective", "loss", "--loss", "not in the paper"},
    {"minimiser", "matches at every step or evaluation", "--reassociation", "not in the paper"},
};

// A formula as code; Markdown's tables want | escaped even there.
std::string FormulaText(const std::string& formula) {
  if (!FLAGS_markdown) {
    return formula;
  }
  std::string text = "`";
  for (const char c : formula) {
    text += c == '|' ? std::string("\\|") : std::string(1, c);
  }
  return text + "`";
}

void ListMetrics() {
  std::vector<std::vector<std::string>> metrics = {
      {"name", "rows", "residual r", "term of eps", "needs", "source"}};
  ForEachMetric([&](auto tag) {
    using Metric = typename decltype(tag)::Metric;
    metrics.push_back({Metric::kName, std::to_string(Metric::kDim), FormulaText(Metric::kFormula),
                       FormulaText(EpsilonText(Metric::kEpsilon)), NeedsColumn(Metric::kNeeds),
                       Metric::kSource});
  });
  PrintAligned(metrics, FLAGS_markdown);
  std::cout << "\n";
  std::vector<std::vector<std::string>> variants = {{"stage", "variant", "flag", "source"}};
  for (const Variant& variant : kVariants) {
    variants.push_back({variant.stage, variant.name, variant.flag, variant.source});
  }
  PrintAligned(variants, FLAGS_markdown);
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(
      argc, argv, "lists the registered metrics, and the variants of the chain's other stages.",
      icpscape::ListMetrics);
}
