// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/scan_pair.h"

#include <utility>

namespace icpscape {

void ScanPair::Reverse() {
  std::swap(source, target);
  for (std::optional<SE3d>* T : {&T_ground_truth, &T_predicted}) {
    if (*T) {
      *T = (*T)->Inverse();
    }
  }
  title += ", reversed";
}

}  // namespace icpscape
