// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_PLY_H_
#define ICPSCAPE_SRC_IO_PLY_H_

#include <string>

#include "icpscape/io/point_columns.h"

namespace icpscape {

/// The vertices of a PLY file (ascii, binary_little_endian or binary_big_endian), from its bytes:
/// properties of any numeric type in any order. Lists and other elements are skipped, and must be
/// whole. `place` is the path. Throws InputError for what is no whole PLY file.
PointTable ReadPly(const std::string& place, const std::string& bytes);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_PLY_H_
