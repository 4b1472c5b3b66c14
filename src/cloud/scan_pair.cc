// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/scan_pair.h"

#include <utility>

namespace icpscape {

void ScanPair::SettleOrigins() {
  ShareOrigin(&source, &target);
  origins = {source.origin, target.origin};
  for (std::optional<SE3d>* T : {&T_ground_truth, &T_predicted}) {
    if (*T) {
      *T = origins.FromUser(**T);
    }
  }
}

void ScanPair::Reverse() {
  std::swap(source, target);
  std::swap(origins.source, origins.target);
  for (std::optional<SE3d>* T : {&T_ground_truth, &T_predicted}) {
    if (*T) {
      *T = (*T)->Inverse();
    }
  }
  title += ", reversed";
}

}  // namespace icpscape
