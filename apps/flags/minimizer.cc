// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/minimizer.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>

#include "apps/flags/objective.h"
#include "apps/run/flag.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Minimiser");

DECLARE_string(loss);

DEFINE_string(reassociation, "every_step",
              "every_step (one Ceres step on frozen pairs, then match again) or every_evaluation "
              "(one Solve whose every pose is matched anew).");
DEFINE_int32(max_iterations, 50, "Largest number of steps.");
DEFINE_double(
    min_step_m, 1e-4,
    "Converged when a step is shorter than this (m) and turns by less than --min_step_deg.");
DEFINE_double(
    min_step_deg, 1e-3,
    "Converged when a step turns by less than this (degrees) and is shorter than --min_step_m.");
DEFINE_double(min_cost_change, 0,
              "If positive: ends where the cost changes by less than this share of it.");
DEFINE_double(max_final_cost, 0, "If positive: ends where the cost is this or less.");
DEFINE_string(dof, "all",
              "Directions in which the source may move: all, planar (yaw, x, y: a vehicle), or "
              "some of roll,pitch,yaw,x,y,z, separated by commas.");

namespace icpscape {
namespace {

DofMask DofFromFlags() {
  if (FLAGS_dof == "all") {
    return kAllDof;
  }
  if (FLAGS_dof == "planar") {
    return kPlanarDof;
  }
  DofMask mask = {};
  const std::vector<std::string> names = Split(FLAGS_dof);
  RequireFlag(!names.empty(), "dof", FLAGS_dof, "all, planar, or some of roll,pitch,yaw,x,y,z");
  for (const std::string& name : names) {
    mask[IndexOfName("degree of freedom", name, {"roll", "pitch", "yaw", "x", "y", "z"})] = true;
  }
  return mask;
}

void CheckReassociation(const MinimizerOptions& options) {
  if (options.reassociation == Reassociation::kEveryStep) {
    return;
  }
  if (FLAGS_loss == "tolerant") {
    throw UsageError(
        "--loss=tolerant curves upwards: expected --reassociation=every_step with it.");
  }
  const std::vector<std::string> metrics = MetricsFromFlags();
  if (ObjectiveSetFromFlags().matching.Rejects() ||
      std::any_of(metrics.begin(), metrics.end(), NeedsFeatures)) {
    throw UsageError(
        "--reassociation=every_evaluation compares sums over all pairs: expected every_step where "
        "pairs are rejected, or lines and patches are fitted.");
  }
}

}  // namespace

MinimizerOptions MinimizerFromFlags() {
  MinimizerOptions options;
  options.max_iterations = FLAGS_max_iterations;
  options.min_step_m = FLAGS_min_step_m;
  options.min_step_rad = FLAGS_min_step_deg * M_PI / 180;
  options.min_cost_change = FLAGS_min_cost_change;
  options.max_final_cost = FLAGS_max_final_cost;
  options.free = DofFromFlags();
  options.threads = ThreadsFromFlags();
  if (FLAGS_reassociation == "every_evaluation") {
    options.reassociation = Reassociation::kEveryEvaluation;
  } else if (FLAGS_reassociation != "every_step") {
    throw UsageError("--reassociation=" + FLAGS_reassociation +
                     ": expected every_step or every_evaluation.");
  }
  CheckReassociation(options);
  if (FLAGS_max_iterations < 1 || !(FLAGS_min_step_m >= 0) || !(FLAGS_min_step_deg >= 0)) {
    throw UsageError(
        "--max_iterations, --min_step_m, --min_step_deg: expected at least 1, 0 and 0.");
  }
  RequireFlag(FLAGS_min_cost_change >= 0 && FLAGS_min_cost_change < 1, "min_cost_change",
              Number(FLAGS_min_cost_change), "a share of at least 0, below 1");
  RequireFlag(FLAGS_max_final_cost >= 0 && std::isfinite(FLAGS_max_final_cost), "max_final_cost",
              Number(FLAGS_max_final_cost), "a number of at least 0");
  return options;
}

void RefuseMinimizerFlags(const std::string& expected) {
  RequireUnchanged([](const Flag& flag) { return flag.file == __FILE__; }, expected);
}

}  // namespace icpscape
