// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_NAMED_H_
#define ICPSCAPE_TESTS_SUPPORT_NAMED_H_

#include <ostream>
#include <string>

namespace icpscape::testing_support {

/// A parameter of a test with the name that it has in the test's name (by
/// testing::PrintToStringParamName) and in its output, where GoogleTest would print bytes. (A
/// PrintTo of the parameter's own type would have to be seen by every file that prints one.)
template <class T>
struct Named {
  std::string name;
  T value;
};
template <class T>
void PrintTo(const Named<T>& parameter, std::ostream* out) {
  *out << parameter.name;
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_NAMED_H_
