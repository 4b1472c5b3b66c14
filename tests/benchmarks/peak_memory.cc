// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/peak_memory.h"

#include <malloc.h>

#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace icpscape {
namespace {

// A line "VmHWM:    1234 kB" of /proc/self/status.
double StatusMb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream words(line);
    std::string key;
    double kib = 0;
    if (words >> key >> kib && key == name + ":") {
      return kib * 1024 / 1e6;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Lets the high-water mark begin anew at what is held now.
bool ResetMark() {
  std::ofstream clear("/proc/self/clear_refs");
  clear << "5" << std::flush;
  return clear.good();
}

}  // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0);  // What earlier work has freed is not held.
  before_mb_ = ResetMark() ? StatusMb("VmRSS") : std::numeric_limits<double>::quiet_NaN();
}

double PeakMemory::Mb() const { return StatusMb("VmHWM") - before_mb_; }

}  // namespace icpscape
