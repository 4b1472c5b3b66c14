// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <cstdio>
#include <string>

#include "apps/app.h"
#include "residuals/registry.h"

DEFINE_bool(markdown, false, "Print the table as Markdown, as in docs/metrics.md.");

namespace icpscape {
namespace {

std::string NeedsText(unsigned needs) {
  std::string text = "points";
  text += (needs & kSourceNormal) != 0 ? ", source normals" : "";
  text += (needs & kTargetNormal) != 0 ? ", target normals" : "";
  return text;
}

void ListMetrics() {
  const char* format =
      FLAGS_markdown ? "| %s | %s | %s | %s | %s |\n" : "%-18s %-4s %-40s %-38s %s\n";
  std::printf(format, "name", "rows", "residual", "needs", "source");
  if (FLAGS_markdown) {
    std::printf(format, "---", "---", "---", "---", "---");
  }
  ForEachMetric([&](auto tag) {
    using Metric = typename decltype(tag)::Metric;
    const std::string formula =
        FLAGS_markdown ? "`" + std::string(Metric::kFormula) + "`" : Metric::kFormula;
    std::printf(format, Metric::kName, std::to_string(Metric::kDim).c_str(), formula.c_str(),
                NeedsText(Metric::kNeeds).c_str(), Metric::kSource);
  });
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  return icpscape::RunApp(argc, argv, "lists the registered metrics.", icpscape::ListMetrics);
}
