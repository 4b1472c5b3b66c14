// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_RUN_PROGRESS_H_
#define ICPSCAPE_APPS_RUN_PROGRESS_H_

#include <chrono>
#include <string>
#include <utility>

namespace icpscape {

/// "[###-------] 30/100 poses, 12.1/s, 6 s left" on stderr while it is a terminal; silent
/// otherwise.
class Progress {
 public:
  Progress(std::string unit, int total) : unit_(std::move(unit)), total_(total) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void Show(int done);

 private:
  std::string unit_;
  int total_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_RUN_PROGRESS_H_
