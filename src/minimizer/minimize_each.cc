// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/minimize_each.h"

namespace icpscape {

std::vector<MetricIterates> MinimizeEach(const std::vector<Objective>& objectives,
                                         const SE3d& T_start, const MinimizerOptions& options) {
  std::vector<MetricIterates> all;
  for (const Objective& objective : objectives) {
    all.push_back({objective.metric().name, Minimize(objective, T_start, options)});
  }
  return all;
}

}  // namespace icpscape
