// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_MESSAGE_OF_H_
#define ICPSCAPE_TESTS_SUPPORT_MESSAGE_OF_H_

#include <string>

#include "icpscape/common/error.h"

namespace icpscape::testing_support {

/// What the Error says that f() throws; other exceptions pass.
template <class Error = InputError, class F>
std::string MessageOf(const F& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_MESSAGE_OF_H_
