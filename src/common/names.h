// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COMMON_NAMES_H_
#define ICPSCAPE_SRC_COMMON_NAMES_H_

#include <iterator>
#include <string>
#include <vector>

#include "icpscape/common/text.h"

namespace icpscape {

/// The names of an enum whose values count from 0, in their order; specialised beside each enum:
///   template <>
///   struct Names<Fruit> {
///     static constexpr const char* kWhat = "fruit";  // For messages.
///     static constexpr const char* kNames[] = {"apple", "pear"};
///   };
template <class Enum>
struct Names;

template <class Enum>
const char* NameOf(Enum value) {
  return Names<Enum>::kNames[static_cast<std::size_t>(value)];
}

/// Throws UsageError for another name; the message lists all.
template <class Enum>
Enum FromName(const std::string& name) {
  return static_cast<Enum>(IndexOfName(
      Names<Enum>::kWhat, name, {std::begin(Names<Enum>::kNames), std::end(Names<Enum>::kNames)}));
}

/// All values that have a name.
template <class Enum>
std::vector<Enum> AllOf() {
  std::vector<Enum> all;
  for (std::size_t i = 0; i < std::size(Names<Enum>::kNames); ++i) {
    all.push_back(static_cast<Enum>(i));
  }
  return all;
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COMMON_NAMES_H_
