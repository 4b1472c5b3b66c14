// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_GROUND_TRUTH_CHECK_H_
#define ICPSCAPE_APPS_REPORTS_GROUND_TRUTH_CHECK_H_

#include <optional>

#include "icpscape/cloud/scan_pair.h"
#include "icpscape/io/manifest.h"
#include "icpscape/minimizer/ground_truth_check.h"
#include "icpscape/preparation/prepared_pair.h"

namespace icpscape {

/// Checks the pair's ground truth, prints how far point-to-plane moves from it and records that. An
/// exact truth is not refined. Where the check has no answer: throws ComputationError if it is
/// `needed`, else prints that and returns nothing.
std::optional<GroundTruthCheck> ReportGroundTruthCheck(const ScanPair& pair,
                                                       const PreparedPair& scans, bool needed,
                                                       int threads, Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_GROUND_TRUTH_CHECK_H_
