// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/iterates.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "icpscape/common/text.h"
#include "icpscape/io/output.h"
#include "icpscape/landscape/path_projection.h"

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;

PathProjection Project(const SE3d& T, const PathSection& section) {
  return ProjectOntoPath(section.path, T, section.u_min, section.u_max, kRotationLength_m);
}

}  // namespace

void WriteIterates(const std::vector<MetricIterates>& all,
                   const std::optional<PathSection>& section, const PairOrigins& origins,
                   Run* run) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Table csv({"metric",
             "iteration",
             "u",
             "off_path_m",
             "off_path_deg",
             "cost",
             "rmse",
             "n",
             "gradient_norm",
             "smallest_eigenvalue",
             "largest_eigenvalue",
             "step_m",
             "step_deg",
             "time_s",
             "qx",
             "qy",
             "qz",
             "qw",
             "tx_m",
             "ty_m",
             "tz_m"});
  for (const auto& [metric, summary] : all) {
    for (std::size_t i = 0; i < summary.iterates.size(); ++i) {
      const Iterate& it = summary.iterates[i];
      const PathProjection place =
          section ? Project(it.T_target_source, *section) : PathProjection{kNone, kNone, kNone};
      std::vector<std::string> row = {metric, std::to_string(i)};
      for (const double value :
           {place.u, place.off_path_m, place.off_path_rad * kDegrees, it.cost, it.rmse,
            static_cast<double>(it.n), it.gradient_norm, it.smallest_eigenvalue,
            it.largest_eigenvalue, it.step_m, it.step_rad * kDegrees, it.time_s}) {
        row.push_back(Number(value));
      }
      double x[7];
      origins.ToUser(it.T_target_source).ToParameters(x);
      for (const double value : x) {
        row.push_back(Number(value));
      }
      csv.AddRow(std::move(row));
    }
  }
  csv.WriteCsv(run->File("iterates.csv"));
}

void PrintIterates(const MinimizerSummary& summary) {
  std::printf("%4s %22s %12s %8s %11s %11s %11s %8s\n", "iter", "cost", "RMSE", "n", "eig min/max",
              "step (m)", "step (deg)", "time (s)");
  for (std::size_t i = 0; i < summary.iterates.size(); ++i) {
    const Iterate& it = summary.iterates[i];
    std::printf("%4zu %22.15g %12.8f %8ld %11.3e %11.3e %11.3e %8.3f\n", i, it.cost, it.rmse, it.n,
                it.smallest_eigenvalue / it.largest_eigenvalue, it.step_m, it.step_rad * kDegrees,
                it.time_s);
  }
}

void ReportEnds(const std::vector<MetricIterates>& all, const PathSection& section,
                Manifest* manifest) {
  std::printf("%-18s %6s %8s %12s %14s  %s\n", "minimised", "steps", "ends at u", "off path (m)",
              "off path (deg)", "ends with");
  for (const auto& [metric, summary] : all) {
    if (summary.iterates.empty()) {
      std::printf("%-18s: %s\n", metric.c_str(), summary.message.c_str());
      continue;
    }
    const PathProjection end = Project(summary.T_target_source(), section);
    std::printf("%-18s %6zu %9.4f %12.4f %14.4f  %s\n", metric.c_str(), summary.iterates.size() - 1,
                end.u, end.off_path_m, end.off_path_rad * kDegrees, NameOf(summary.termination));
    manifest->SetResult("iterates_end_u_" + metric, end.u);
    manifest->SetResult("iterates_end_off_path_m_" + metric, end.off_path_m);
  }
}

}  // namespace icpscape
