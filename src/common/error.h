// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COMMON_ERROR_H_
#define ICPSCAPE_SRC_COMMON_ERROR_H_

#include <stdexcept>

namespace icpscape {

/// The command line, an option or an argument of a call is wrong (exit code 1).
/// Every message is one sentence naming the place and what was expected.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The data are wrong: a file is missing, truncated or says something impossible (exit code 2).
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The data are readable but the computation has no answer (exit code 3).
struct ComputationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// There is a pose, and the results are written, but its verdict is bad: undetermined, or not
/// converged (exit code 4).
struct DoubtfulPose : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COMMON_ERROR_H_
