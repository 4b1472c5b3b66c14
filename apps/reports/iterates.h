// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_ITERATES_H_
#define ICPSCAPE_APPS_REPORTS_ITERATES_H_

#include <filesystem>
#include <string>
#include <vector>

#include "src/io/manifest.h"
#include "src/landscape/curve.h"
#include "src/minimizer/minimizer.h"

namespace icpscape {

/// The closed loop of one metric, beside its curve.
struct MetricIterates {
  std::string metric;
  MinimizerSummary summary;
};

/// Minimises each objective by itself from the start of the path. One whose pairs give out keeps
/// the iterates up to there.
std::vector<MetricIterates> MinimizeEach(const std::vector<Objective>& objectives,
                                         const SE3d& T_initial, const MinimizerOptions& options);

/// Prints and records where each metric's iterates end, and writes iterates.csv: every iterate at
/// its nearest u within the curve's interval, with its distance from the path there (see
/// PathProjection; rotations count kRotationLength_m).
void ReportIterates(const std::vector<MetricIterates>& all, const Path& path,
                    const CurveOptions& curve, const std::filesystem::path& out,
                    Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_ITERATES_H_
