// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_TEXT_RECORDS_H_
#define ICPSCAPE_SRC_IO_TEXT_RECORDS_H_

#include <vector>

#include "icpscape/io/point_columns.h"
#include "icpscape/io/text_lines.h"

namespace icpscape {

/// Reads `count` records, a line each, of fields that are numbers and lists in this order. The
/// table has the used columns. Throws InputError that names file and line for a line with fewer
/// words or more, and for a word that is not wholly a number, or not a whole one where the field's
/// type is. Memory for records that the rest of the text cannot hold is not asked for.
PointTable ReadTextRecords(const std::vector<Field>& fields, std::size_t count, TextLines* lines);

/// Throws InputError for words in the rest of the text.
void RequireEnd(TextLines* lines);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_TEXT_RECORDS_H_
