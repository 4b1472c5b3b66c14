// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/registration.h"

#include <algorithm>
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

}  // namespace

void ReportPose(const std::string& what, const std::string& name, const SE3d& T,
                Manifest* manifest) {
  const double degrees = T.LogRotation().norm() * kDegrees;
  std::printf("%s: %.4f m, %.4f deg\n", what.c_str(), T.t().norm(), degrees);
  manifest->SetResult(name + "_m", T.t().norm());
  manifest->SetResult(name + "_deg", degrees);
}

void ReportRegistration(const std::string& name, const MinimizerSummary& summary,
                        const PairOrigins& origins, Run* run) {
  PrintIterates(summary);
  WriteIterates({{name, summary}}, std::nullopt, origins, run);
  std::printf("%s: %s\nfinal cost: %s\n", NameOf(summary.termination), summary.message.c_str(),
              Number(summary.final_cost()).c_str());
  Manifest* const manifest = run->manifest();
  manifest->SetResult("termination", NameOf(summary.termination));
  manifest->SetResult("final_cost", summary.final_cost());
  manifest->SetResult("matching_passes", summary.matching_passes);
  const SE3d& T = summary.T_target_source();
  ReportPose("motion", "motion", origins.Motion(T), manifest);
  WriteTextFile(run->File("T_target_source.txt"), FormatTransform(origins.ToUser(T)));
}

void ReportStarts(const std::vector<StartResult>& results, const RandomStartOptions& options,
                  Run* run) {
  Table csv({"start", "start_m", "start_deg", "end_m", "end_deg", "iterations", "termination",
             "success"});
  for (std::size_t i = 0; i < results.size(); ++i) {
    const StartResult& r = results[i];
    csv.AddRow({std::to_string(i), Number(r.start_m), Number(r.start_rad * kDegrees),
                Number(r.end_m), Number(r.end_rad * kDegrees), std::to_string(r.iterations),
                NameOf(r.termination), r.success ? "1" : "0"});
  }
  csv.WriteCsv(run->File("starts.csv"));
  const auto successes =
      std::count_if(results.begin(), results.end(), [](const StartResult& r) { return r.success; });
  const double percent =
      100.0 * static_cast<double>(successes) / static_cast<double>(results.size());
  std::printf(
      "random starts up to %g m, %g deg: %ld of %zu succeed (%.1f %%; within %g m and %g "
      "deg of the refined reference)\n",
      options.translation_m, options.rotation_rad * kDegrees, static_cast<long>(successes),
      results.size(), percent, kSuccessM, kSuccessRad * kDegrees);
  run->manifest()->SetResult("success_percent", percent);
  run->manifest()->AddTiming("starts");
}

}  // namespace icpscape
