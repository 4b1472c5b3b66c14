// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_REGISTRATION_H_
#define ICPSCAPE_APPS_REPORTS_REGISTRATION_H_

#include <string>

#include "apps/run/run.h"
#include "icpscape/cloud/displacement.h"
#include "icpscape/cloud/origin.h"
#include "icpscape/minimizer/registration.h"

namespace icpscape {

/// Prints and records a length and an angle: "WHAT: 0.1234 m, 0.5678 deg", and under NAME_m and
/// NAME_deg.
void ReportDisplacement(const std::string& what, const std::string& name,
                        const Displacement& displacement, Manifest* manifest);

/// Prints and records how a registration by the objective of that name went; writes iterates.csv
/// and T_target_source.txt, with poses in the coordinates of the user, and stages.csv where there
/// were several.
void ReportRegistration(const std::string& name, const Registered& registered,
                        const PairOrigins& origins, Run* run);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_REGISTRATION_H_
