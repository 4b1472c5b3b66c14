// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/ground_truth_check.h"

#include <cmath>
#include <cstdio>
#include <iostream>

#include "icpscape/common/error.h"

namespace icpscape {

std::optional<GroundTruthCheck> ReportGroundTruthCheck(const ScanPair& pair,
                                                       const PreparedPair& scans, bool needed,
                                                       int threads, Manifest* manifest) {
  if (pair.truth_is_exact) {
    std::cout << "ground truth: exact, since simulated\n";
    GroundTruthCheck check;
    check.T_refined = *pair.T_ground_truth;
    return check;
  }
  try {
    GroundTruthCheck check =
        CheckGroundTruth(*scans.source.clouds().points, *scans.target.clouds().points,
                         *pair.T_ground_truth, threads);
    const double degrees = check.rotation_rad * 180 / M_PI;
    std::printf("ground-truth check: point-to-plane ends %.4f m, %.4f deg from it\n",
                check.translation_m, degrees);
    manifest->SetResult("ground_truth_check_m", check.translation_m);
    manifest->SetResult("ground_truth_check_deg", degrees);
    manifest->AddTiming("ground_truth_check");
    return check;
  } catch (const ComputationError& error) {
    if (needed) {
      throw;
    }
    std::cout << "ground-truth check: no answer (" << error.what() << ")\n";
    return std::nullopt;
  }
}

}  // namespace icpscape
