// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_FLAGS_RUN_H_
#define ICPSCAPE_APPS_FLAGS_RUN_H_

#include <filesystem>

namespace icpscape {

/// --threads, or all of the machine where it is 0. Throws UsageError.
int ThreadsFromFlags();

/// --out, created and proved writable, without a manifest: that is written last. Throws UsageError,
/// InputError.
std::filesystem::path OutputFolder();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_FLAGS_RUN_H_
