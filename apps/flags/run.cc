// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/run.h"

#include <gflags/gflags.h>

#include "apps/run/app.h"
#include "src/common/parallel.h"
#include "src/io/output.h"

DEFINE_int32(threads, 0, "Threads; 0 is all of the machine. Results do not depend on it.");
DEFINE_string(out, "out", "Folder for the results.");

namespace icpscape {

int ThreadsFromFlags() {
  RequireFlag(FLAGS_threads >= 0 && FLAGS_threads <= 1024, "threads", std::to_string(FLAGS_threads),
              "0 (all) to 1024");
  return FLAGS_threads > 0 ? FLAGS_threads : HardwareThreads();
}

std::filesystem::path OutputFolder() {
  RequireFlag(!FLAGS_out.empty(), "out", FLAGS_out, "a folder");
  PrepareOutputFolder(FLAGS_out);
  // Written last: a folder with a manifest is a finished run.
  std::filesystem::remove(std::filesystem::path(FLAGS_out) / "manifest.json");
  return FLAGS_out;
}

}  // namespace icpscape
