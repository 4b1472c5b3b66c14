// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/curves.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "icpscape/common/text.h"
#include "icpscape/io/output.h"

namespace icpscape {

void WriteCurves(const std::vector<Curve>& curves, Run* run) {
  Table csv({"metric", "u", "rmse", "rms_residual", "cost", "n", "slope_analytic", "slope_numeric",
             "inlier_ratio", "epsilon", "rmse_fixed_n"});
  for (const Curve& curve : curves) {
    Table pgfplots({"u", "rmse"});
    for (const CurvePoint& p : curve.points) {
      csv.AddRow({curve.metric, Number(p.u), Number(p.rmse), Number(p.rms_residual), Number(p.cost),
                  Number(p.n), Number(p.slope_analytic), Number(p.slope_numeric),
                  Number(p.inlier_ratio), Number(p.epsilon), Number(p.rmse_fixed_n)});
      pgfplots.AddRow({Number(p.u), Number(p.rmse)});
    }
    pgfplots.WritePgfplots(run->File(curve.metric + "_rmse.txt"));
  }
  csv.WriteCsv(run->File("curves.csv"));
}

void ReportMinima(const std::vector<Curve>& curves, const CurveColumn& column, double motion_m,
                  Manifest* manifest) {
  std::printf("%-18s %8s %14s %18s %9s\n", "metric", "argmin u", "off by (m)",
              (std::string(column.name) + " there").c_str(), "n");
  for (const Curve& curve : curves) {
    const CurvePoint& minimum = curve.Minimum(column.value);
    std::printf("%-18s %8.4f %14.4f %18.6f %9.0f\n", curve.metric.c_str(), minimum.u,
                std::abs(minimum.u - 1) * motion_m, minimum.*column.value, minimum.n);
    manifest->SetResult("argmin_u_" + curve.metric, minimum.u);
  }
}

}  // namespace icpscape
