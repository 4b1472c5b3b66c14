// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/free_directions.h"

#include <Eigen/QR>
#include <algorithm>

namespace icpscape {

Directions FreeDirections(const DofMask& free, const Mat6& about_point) {
  Directions columns(6, std::count(free.begin(), free.end(), true));
  for (Eigen::Index i = 0, k = 0; i < 6; ++i) {
    if (free[static_cast<std::size_t>(i)]) {
      columns.col(k++) = about_point.col(i);
    }
  }
  const Eigen::MatrixXd Q = columns.householderQr().householderQ();
  return Q.leftCols(columns.cols());
}

}  // namespace icpscape
