// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/minimizer.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>

#include "apps/flags/objective.h"
#include "apps/flags/run.h"
#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/common/text.h"

DECLARE_string(loss);

DEFINE_string(
    weights, "",
    "Weights of the metrics that are minimised together, separated by commas; none is 1 each.");
DEFINE_string(reassociation, "every_step",
              "every_step (one Ceres step on frozen pairs, then match again) or every_evaluation "
              "(one Solve whose every pose is matched anew).");
DEFINE_int32(max_iterations, 50, "Most steps.");
DEFINE_double(min_step_m, 1e-4, "Converged when a step is shorter than this (m) ...");
DEFINE_double(min_step_deg, 1e-3, "... and turns by less than this (degrees).");
DEFINE_double(min_cost_change, 0,
              "If positive: end where the cost changes by less than this share of it.");
DEFINE_double(max_final_cost, 0, "If positive: end where the cost is this or less.");
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

void CheckWeightFlags() {
  const std::vector<std::string> weights = Split(FLAGS_weights);
  RequireFlag(weights.empty() || weights.size() == MetricsFromFlags().size(), "weights",
              FLAGS_weights, "one weight per metric");
  for (const std::string& weight : weights) {
    RequireFlag(ParseNumber(weight) > 0 && std::isfinite(ParseNumber(weight)), "weights",
                FLAGS_weights, "positive numbers");
  }
}

JointObjective JointFromFlags(const std::vector<Objective>& objectives) {
  CheckWeightFlags();
  const std::vector<std::string> weights = Split(FLAGS_weights);
  std::vector<JointObjective::Term> terms;
  for (std::size_t i = 0; i < objectives.size(); ++i) {
    terms.push_back({&objectives[i], weights.empty() ? 1.0 : ParseNumber(weights[i])});
  }
  return JointObjective(std::move(terms));
}

}  // namespace icpscape
