// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MINIMIZER_MINIMIZE_EACH_H_
#define ICPSCAPE_SRC_MINIMIZER_MINIMIZE_EACH_H_

#include <string>
#include <vector>

#include "icpscape/minimizer/minimizer.h"

namespace icpscape {

/// The closed loop of one metric.
struct MetricIterates {
  std::string metric;
  MinimizerSummary summary;
};

/// Minimises each objective by itself from the same start. Where the pairs of one give out, its
/// summary keeps the iterates up to there.
std::vector<MetricIterates> MinimizeEach(const std::vector<Objective>& objectives,
                                         const SE3d& T_start, const MinimizerOptions& options);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MINIMIZER_MINIMIZE_EACH_H_
