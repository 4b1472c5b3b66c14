// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/neighbors/neighborhoods.h"

#include "icpscape/neighbors/search_kernels.h"

namespace icpscape {

void Neighborhoods::Resize(std::size_t size) {
  count.resize(size);
  nearest.resize(size);
  farthest_squared_distance.resize(size);
  for (std::vector<double>* sums : {&x, &y, &z, &xx, &xy, &xz, &yy, &yz, &zz}) {
    sums->resize(size);
  }
}

Eigen::Vector3d Neighborhoods::Mean(std::size_t i) const {
  return Eigen::Vector3d(x[i], y[i], z[i]) / static_cast<double>(count[i]);
}

void Neighborhoods::CenterProducts() {
  for (std::size_t i = 0; i < size(); ++i) {
    const double n = count[i];
    xx[i] -= x[i] * x[i] / n;
    xy[i] -= x[i] * y[i] / n;
    xz[i] -= x[i] * z[i] / n;
    yy[i] -= y[i] * y[i] / n;
    yz[i] -= y[i] * z[i] / n;
    zz[i] -= z[i] * z[i] / n;
  }
}

Eigen::Matrix3d Neighborhoods::Products(std::size_t i) const {
  Eigen::Matrix3d products;
  products << xx[i], xy[i], xz[i], xy[i], yy[i], yz[i], xz[i], yz[i], zz[i];
  return products;
}

void PrincipalAxes::Compute(const Neighborhoods& neighborhoods) {
  const std::size_t size = neighborhoods.size();
  for (std::vector<double>* out : {&smallest, &middle, &largest, &smallest_x, &smallest_y,
                                   &smallest_z, &largest_x, &largest_y, &largest_z}) {
    out->resize(size);
  }
  SearchKernelsAt(ActiveSimdLevel())
      .eigen(size,
             {neighborhoods.xx.data(), neighborhoods.xy.data(), neighborhoods.xz.data(),
              neighborhoods.yy.data(), neighborhoods.yz.data(), neighborhoods.zz.data(),
              smallest.data(), middle.data(), largest.data(), smallest_x.data(), smallest_y.data(),
              smallest_z.data(), largest_x.data(), largest_y.data(), largest_z.data()});
}

}  // namespace icpscape
