// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_REGISTRATION_H_
#define ICPSCAPE_APPS_REPORTS_REGISTRATION_H_

#include <string>

#include "apps/run/run.h"
#include "icpscape/cloud/origin.h"
#include "icpscape/minimizer/random_starts.h"

namespace icpscape {

/// Prints and records a length and an angle of a pose: "WHAT: 0.1234 m, 0.5678 deg", and under
/// NAME_m and NAME_deg.
void ReportPose(const std::string& what, const std::string& name, const SE3d& T,
                Manifest* manifest);

/// Prints and records how a minimisation of the objective of that name went and what motion it
/// found; writes iterates.csv and T_target_source.txt, with poses in the coordinates of the user.
void ReportRegistration(const std::string& name, const MinimizerSummary& summary,
                        const PairOrigins& origins, Run* run);

/// Prints and records how many random starts succeed, and writes starts.csv.
void ReportStarts(const std::vector<StartResult>& results, const RandomStartOptions& options,
                  Run* run);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_REGISTRATION_H_
