// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_CURVES_H_
#define ICPSCAPE_APPS_REPORTS_CURVES_H_

#include <vector>

#include "apps/run/run.h"
#include "icpscape/landscape/curve.h"

namespace icpscape {

/// Writes curves.csv, all columns of all curves, and for each METRIC_rmse.txt for pgfplots.
void WriteCurves(const std::vector<Curve>& curves, Run* run);

/// Prints and records where on the path each curve is least in this column. `motion_m` is the
/// length of the translation from u = 0 to u = 1.
void ReportMinima(const std::vector<Curve>& curves, const CurveColumn& column, double motion_m,
                  Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_CURVES_H_
