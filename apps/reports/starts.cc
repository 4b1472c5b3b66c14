// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/starts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/run/progress.h"
#include "icpscape/common/text.h"
#include "icpscape/io/output.h"

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;

void Report(const std::vector<StartResult>& results, const RandomStartOptions& options, Run* run) {
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

}  // namespace

void RunStarts(const Registration& registration, const SE3d& T_reference, const Vec3& centroid,
               const RandomStartOptions& options, Run* run) {
  const LoopFrom loop = [&](const SE3d& T_start, const MinimizerOptions& how) {
    return registration.Run(T_start, how).summary;
  };
  std::vector<StartResult> results;
  {
    Progress progress("starts", options.count);
    results = RunRandomStarts(loop, T_reference, centroid, options,
                              [&](int done) { progress.Show(done); });
  }
  Report(results, options, run);
}

}  // namespace icpscape
