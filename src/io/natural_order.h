// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_NATURAL_ORDER_H_
#define ICPSCAPE_SRC_IO_NATURAL_ORDER_H_

#include <string>

namespace icpscape {

/// Whether a comes before b as people sort names: runs of digits are compared as whole numbers of
/// any length ("scan_2" before "scan_10"), letters without regard to case, all else byte by byte.
/// Names that are equal so ("scan_01" and "Scan_1") are compared byte by byte.
bool ComesBefore(const std::string& a, const std::string& b);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_NATURAL_ORDER_H_
