// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_BINARY_RECORDS_H_
#define ICPSCAPE_SRC_IO_BINARY_RECORDS_H_

#include <vector>

#include "icpscape/io/point_columns.h"

namespace icpscape {

/// Bytes of a file, record after record.
struct BinaryPart {
  const std::string& bytes;
  std::size_t position = 0;  ///< Of the next record.
  bool big_endian = false;
};

/// Reads `count` records of fields that are numbers and lists in this order, from the position,
/// which moves to their end. The table has the used columns. Throws InputError naming `place` where
/// the bytes end before the records do, before any memory is asked for.
PointTable ReadBinaryRecords(const std::string& place, const std::vector<Field>& fields,
                             std::size_t count, BinaryPart* part);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_BINARY_RECORDS_H_
