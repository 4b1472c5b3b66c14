// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_BIN_LAYOUT_H_
#define ICPSCAPE_SRC_IO_BIN_LAYOUT_H_

#include <string>

namespace icpscape {

/// Throws InputError where the bytes of a file are plainly no points of four floats, x y z
/// intensity: where many are no coordinates as floats, or where another number of floats a point
/// fits much better.
///
/// With s floats a point, each column has the spread of its kind: metres along x, less along z, a
/// ring's number. With another s every column mixes kinds, and has the spread of all. What fits has
/// the least mean over the columns of log variance; another s must be less by 0.3, and 8 by 1.
/// Files of four floats are not: mixing columns only adds spread. Less than 840 floats tell
/// nothing.
void CheckFourFloats(const std::string& place, const std::string& bytes);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_BIN_LAYOUT_H_
