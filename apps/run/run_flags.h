// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_RUN_RUN_FLAGS_H_
#define ICPSCAPE_APPS_RUN_RUN_FLAGS_H_

#include <filesystem>

#include "icpscape/common/names.h"

namespace icpscape {

/// What is drawn.
enum class FigureFormats { kNone, kSvg, kPng, kAll };
template <>
struct Names<FigureFormats> {
  static constexpr const char* kWhat = "kind of figures";
  static constexpr const char* kNames[] = {"none", "svg", "png", "all"};
};

/// --figures. Throws UsageError.
FigureFormats FigureFormatsFromFlags();

/// --threads, or the number of all threads of the machine where it is 0. Throws UsageError.
int ThreadsFromFlags();

/// --out. Throws UsageError where it is empty.
std::filesystem::path OutFromFlags();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_RUN_RUN_FLAGS_H_
