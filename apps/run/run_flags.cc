// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run/run_flags.h"

#include <gflags/gflags.h>

#include "apps/run/flag.h"
#include "icpscape/common/parallel.h"

static const icpscape::FlagGroup group(__FILE__, "Run", icpscape::kAside);

DEFINE_int32(threads, 0,
             "Number of threads; 0 uses all of the machine. Results do not depend on it.");
DEFINE_string(out, "out", "Folder for the results.");
DEFINE_string(figures, "all",
              "Figures to draw: none, svg, png, all. Drawing takes a second or two.");

namespace icpscape {

int ThreadsFromFlags() {
  RequireFlag(FLAGS_threads >= 0 && FLAGS_threads <= 1024, "threads", std::to_string(FLAGS_threads),
              "0 (all) to 1024");
  return FLAGS_threads > 0 ? FLAGS_threads : HardwareThreads();
}

FigureFormats FigureFormatsFromFlags() { return FromName<FigureFormats>(FLAGS_figures); }

std::filesystem::path OutFromFlags() {
  RequireFlag(!FLAGS_out.empty(), "out", FLAGS_out, "a folder");
  return FLAGS_out;
}

}  // namespace icpscape
