// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_VERDICT_H_
#define ICPSCAPE_APPS_FLAGS_VERDICT_H_

#include "apps/reports/verdict.h"

namespace icpscape {

/// --tolerance_m and --tolerance_deg, for the results of this loop. Throws UsageError.
VerdictOptions VerdictFromFlags(const MinimizerOptions& minimizer);

/// --accept. Throws UsageError.
AcceptedVerdicts AcceptedFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_VERDICT_H_
