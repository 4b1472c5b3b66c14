// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PAPER_PULL_H_
#define ICPSCAPE_SRC_PAPER_PULL_H_

#include <string>
#include <vector>

#include "icpscape/objective/objective.h"

namespace icpscape {

/// Where a group of source points pulls the minimum: its share of eps at u = 0 and at u = 1. A
/// group with more at 1 than at 0 pulls to u = 0.
struct Pull {
  std::string group;  ///< "10 to 20 m", or "label 48" (semantic class) where there are labels.
  double n_0 = 0;     ///< Pairs at u = 0.
  double epsilon_0 = 0;
  double n_1 = 0;
  double epsilon_1 = 0;
};

/// One for each range bin (0, 5, 10, 20, 40 m and on) and each semantic class; re-associated at
/// both poses.
std::vector<Pull> Pulls(const Objective& objective, const SE3d& T_0, const SE3d& T_1, int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PAPER_PULL_H_
