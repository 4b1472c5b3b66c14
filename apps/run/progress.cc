// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace icpscape {

Progress::~Progress() {
  if (shown_) {
    std::fputs("\r\033[K", stderr);
  }
}

void Progress::Show(int done) {
  if (isatty(STDERR_FILENO) == 0) {
    return;
  }
  shown_ = true;
  constexpr int kWidth = 20;
  const int marks = kWidth * done / std::max(1, total_);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::fprintf(stderr, "\r[%s%s] %d/%d %s, %.1f/s, %.0f s left\033[K",
               std::string(static_cast<std::size_t>(marks), '#').c_str(),
               std::string(static_cast<std::size_t>(kWidth - marks), '-').c_str(), done, total_,
               unit_.c_str(), done / seconds, seconds / done * (total_ - done));
  std::fflush(stderr);
}

}  // namespace icpscape
