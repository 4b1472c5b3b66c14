// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_TEXT_POINTS_H_
#define ICPSCAPE_SRC_IO_TEXT_POINTS_H_

#include <string>

#include "icpscape/io/point_columns.h"

namespace icpscape {

/// The points of a table in text, one a line, under a line of names, with commas, semicolons or
/// blanks between them. Names may stand behind "#" or "//". Other such lines before the first point
/// are comments. Without names the first three columns are x, y and z where `xyz_first`; else that
/// is an InputError, as it is in ReadTextRecords.
PointTable ReadTextPoints(const std::string& place, const std::string& bytes, bool xyz_first);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_TEXT_POINTS_H_
