// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_PCD_H_
#define ICPSCAPE_SRC_IO_PCD_H_

#include <string>

#include "icpscape/io/point_columns.h"

namespace icpscape {

/// The points of a PCD file (ascii, binary or binary_compressed), whose bytes it takes: fields of
/// any type and count in any order, padding included. The translation of VIEWPOINT is where the
/// sensor was; its rotation says where the sensor looked, and moves no point. `place` is the path.
/// Throws InputError for what is no whole PCD file.
PointTable ReadPcd(const std::string& place, std::string bytes);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_PCD_H_
