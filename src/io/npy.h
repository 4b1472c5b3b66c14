// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_NPY_H_
#define ICPSCAPE_SRC_IO_NPY_H_

#include <string>

#include "icpscape/io/point_columns.h"

namespace icpscape {

/// The points of a .npy file of NumPy's, whose bytes it takes: an array of N x 3 or more numbers,
/// whose columns are x, y, z and, where there are four, intensity; or a structured array of N,
/// whose fields have names. In C's or Fortran's order, of either byte order. `place` is the path.
/// Throws InputError for what is no whole file of such an array.
PointTable ReadNpy(const std::string& place, std::string bytes);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_NPY_H_
