// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COMMON_TEXT_H_
#define ICPSCAPE_SRC_COMMON_TEXT_H_

#include <cstddef>
#include <string>
#include <vector>

namespace icpscape {

/// The shortest decimal text that reads back as the same double.
std::string Number(double value);

/// The number that the whole text spells; NaN where it does not spell one.
double ParseNumber(const std::string& text);

/// With that many digits after the point, for people.
std::string Fixed(double value, int digits);

/// "a, b, c".
std::string Join(const std::vector<std::string>& parts, const std::string& separator = ", ");

/// "a,b,c" -> {a, b, c}; empty parts are dropped.
std::vector<std::string> Split(const std::string& text, char separator = ',');

/// The place of `name` in `names`. Throws UsageError that names them all: "unknown WHAT ...".
std::size_t IndexOfName(const std::string& what, const std::string& name,
                        const std::vector<std::string>& names);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COMMON_TEXT_H_
