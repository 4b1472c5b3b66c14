// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_JOINT_H_
#define ICPSCAPE_APPS_FLAGS_JOINT_H_

#include <vector>

#include "src/objective/joint_objective.h"

namespace icpscape {

/// --weights, one for each of --metrics; none where the flag is empty. Throws UsageError.
std::vector<double> WeightsFromFlags();

/// The metrics of --metrics as the weighted sum that --weights says. Throws UsageError.
JointObjective JointFromFlags(const std::vector<Objective>& objectives);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_JOINT_H_
