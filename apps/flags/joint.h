// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_JOINT_H_
#define ICPSCAPE_APPS_FLAGS_JOINT_H_

#include <vector>

namespace icpscape {

/// --weights, one for each of --metrics; none where the flag is empty. Throws UsageError.
std::vector<double> WeightsFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_JOINT_H_
