// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_MINIMIZER_H_
#define ICPSCAPE_APPS_FLAGS_MINIMIZER_H_

#include <string>

#include "icpscape/minimizer/minimizer.h"

namespace icpscape {

/// The minimiser's options from --reassociation, --max_iterations, --min_step_m, --min_step_deg,
/// --min_cost_change, --max_final_cost, --dof and --threads. Throws UsageError, also where
/// --metrics, --loss or the matching flags cannot go with the way to re-associate.
MinimizerOptions MinimizerFromFlags();

/// Throws UsageError where one of these flags is changed, for a program that does not minimise now.
void RefuseMinimizerFlags(const std::string& expected);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_MINIMIZER_H_
