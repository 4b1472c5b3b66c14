// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_STARTS_H_
#define ICPSCAPE_APPS_REPORTS_STARTS_H_

#include "apps/run/run.h"
#include "icpscape/minimizer/random_starts.h"
#include "icpscape/minimizer/registration.h"

namespace icpscape {

/// Registers from random starts about the reference (see RunRandomStarts). Prints and records how
/// many succeed, and writes starts.csv.
void RunStarts(const Registration& registration, const SE3d& T_reference, const Vec3& centroid,
               const RandomStartOptions& options, Run* run);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_STARTS_H_
