// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/iterates.h"

#include <cmath>
#include <cstdio>

#include "src/common/text.h"
#include "src/io/output.h"
#include "src/landscape/path_projection.h"

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;

std::vector<std::string> Row(const std::string& metric, std::size_t index, const Iterate& iterate,
                             const PathProjection& projection) {
  std::vector<std::string> row = {metric,
                                  std::to_string(index),
                                  Number(projection.u),
                                  Number(projection.off_path_m),
                                  Number(projection.off_path_rad * kDegrees),
                                  Number(iterate.rmse),
                                  Number(iterate.cost),
                                  std::to_string(iterate.n),
                                  Number(iterate.step_m),
                                  Number(iterate.step_rad * kDegrees)};
  double x[7];
  iterate.T_target_source.ToParameters(x);
  for (const double value : x) {
    row.push_back(Number(value));
  }
  return row;
}

}  // namespace

std::vector<MetricIterates> MinimizeEach(const std::vector<Objective>& objectives,
                                         const SE3d& T_initial, const MinimizerOptions& options) {
  std::vector<MetricIterates> all;
  for (const Objective& objective : objectives) {
    all.push_back(
        {objective.metric(), Minimize(JointObjective({{&objective, 1.0}}), T_initial, options)});
  }
  return all;
}

void ReportIterates(const std::vector<MetricIterates>& all, const Path& path,
                    const CurveOptions& curve, const std::filesystem::path& out,
                    Manifest* manifest) {
  Table csv({"metric", "iteration", "u", "off_path_m", "off_path_deg", "rmse", "cost", "n",
             "step_m", "step_deg", "qx", "qy", "qz", "qw", "tx_m", "ty_m", "tz_m"});
  std::printf("%-18s %6s %8s %12s %14s  %s\n", "minimised", "steps", "ends at u", "off path (m)",
              "off path (deg)", "ends with");
  for (const auto& [metric, summary] : all) {
    PathProjection projection;
    for (std::size_t i = 0; i < summary.iterates.size(); ++i) {
      const Iterate& iterate = summary.iterates[i];
      projection = ProjectOntoPath(path, iterate.T_target_source, curve.u_min, curve.u_max,
                                   kRotationLength_m);
      csv.AddRow(Row(metric, i, iterate, projection));
    }
    if (summary.iterates.empty()) {
      std::printf("%-18s: %s\n", metric.c_str(), summary.message.c_str());
      continue;
    }
    std::printf("%-18s %6zu %9.4f %12.4f %14.4f  %s\n", metric.c_str(), summary.iterates.size() - 1,
                projection.u, projection.off_path_m, projection.off_path_rad * kDegrees,
                TerminationName(summary.termination));
    manifest->SetResult("iterates_end_u_" + metric, projection.u);
    manifest->SetResult("iterates_end_off_path_m_" + metric, projection.off_path_m);
  }
  csv.WriteCsv(out / "iterates.csv");
}

}  // namespace icpscape
