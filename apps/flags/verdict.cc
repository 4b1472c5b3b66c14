// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/verdict.h"

#include <gflags/gflags.h>

#include <cmath>

#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Verdict", icpscape::kAside);

DEFINE_double(
    tolerance_m, icpscape::VerdictOptions().tolerance_m,
    "A direction counts as undetermined where the position's predicted standard deviation "
    "along it is beyond this (m).");
DEFINE_double(tolerance_deg, 0.3, "The same for the angle about an axis (degrees).");
DEFINE_string(
    accept, "",
    "Doubtful poses that end with exit code 0 and not 4, separated by commas: "
    "undetermined (some direction is), limit (the steps ended before the pose converged), "
    "cycle (the poses came again and again).");

namespace icpscape {

VerdictOptions VerdictFromFlags(const MinimizerOptions& minimizer) {
  RequireFlag(FLAGS_tolerance_m > 0 && std::isfinite(FLAGS_tolerance_m), "tolerance_m",
              Number(FLAGS_tolerance_m), "a positive length");
  RequireFlag(FLAGS_tolerance_deg > 0 && FLAGS_tolerance_deg <= 180, "tolerance_deg",
              Number(FLAGS_tolerance_deg), "more than 0 and at most 180 degrees");
  VerdictOptions options;
  options.tolerance_m = FLAGS_tolerance_m;
  options.tolerance_rad = FLAGS_tolerance_deg * M_PI / 180;
  options.minimizer = minimizer;
  return options;
}

AcceptedVerdicts AcceptedFromFlags() {
  AcceptedVerdicts accepted;
  bool* const members[] = {&accepted.undetermined, &accepted.limit, &accepted.cycle};
  for (const std::string& name : Split(FLAGS_accept)) {
    *members[IndexOfName("verdict in --accept", name, {"undetermined", "limit", "cycle"})] = true;
  }
  return accepted;
}

}  // namespace icpscape
