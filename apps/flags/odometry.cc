// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/odometry.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>

#include "apps/flags/filters.h"
#include "apps/flags/joint.h"
#include "apps/flags/minimizer.h"
#include "apps/flags/objective.h"
#include "apps/flags/preparation.h"
#include "apps/flags/verdict.h"
#include "apps/run/flag.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Odometry");

DECLARE_string(reassociation);

DEFINE_string(mode, "scan_to_map",
              "What a scan is registered to: scan_to_scan (the one before, the paper's), "
              "scan_to_map, or two_stage (LOAM: the one before, and every few scans the map). "
              "scan_to_map sets --voxel_m=0.25 (not for metrics of edge and planar points), "
              "--adaptive_gate_m=2 and --loss=huber unless they are given.");
DEFINE_double(map_voxel_m, 0.5, "The map keeps one point per voxel of this size (m).");
DEFINE_double(map_radius_m, 80, "The map drops points farther away than this (m).");
DEFINE_int32(map_scans, 0,
             "The map keeps points of this many last scans; 0 is no limit, 1 the paper's map.");
DEFINE_int32(map_every, 10, "With two_stage: number of scans from one mapping step to the next.");
DEFINE_string(prediction, "constant_velocity",
              "Predicted pose, for the start and the filters: constant_velocity (the motion of the "
              "scan before) or none (the identity).");
DEFINE_string(
    deskew, "auto",
    "De-skewing, which moves each point of a scan by the predicted motion to where it was "
    "at the scan's instant: auto (scans whose points have times), on (a scan without is "
    "refused) or off.");
DEFINE_double(adaptive_gate_m, 0,
              "If positive: the gate is three times the RMS error of the predicted poses so far "
              "(KISS-ICP), at most five times this and at most --max_distance_m; this is the "
              "assumed error of "
              "the first (m).");

namespace icpscape {

void SetDefaultsOfMode() {
  const std::vector<std::string> metrics = MetricsFromFlags();
  if (FromName<OdometryMode>(FLAGS_mode) == OdometryMode::kScanToMap) {
    if (std::none_of(metrics.begin(), metrics.end(), NeedsFeatures)) {
      SetFlagDefault("voxel_m", "0.25");
    }
    if (FLAGS_reassociation != "every_evaluation") {  // Which compares sums over all pairs.
      SetFlagDefault("adaptive_gate_m", "2");
    }
    SetFlagDefault("loss", "huber");
  }
}

OdometryOptions OdometryFromFlags() {
  OdometryOptions options;
  options.mode = FromName<OdometryMode>(FLAGS_mode);
  options.metrics = MetricsFromFlags();
  options.weights = WeightsFromFlags();
  options.preparation = PreparationFromFlags(options.metrics);
  options.filters = FiltersFromFlags();
  options.objective = ObjectiveSetFromFlags();
  options.minimizer = MinimizerFromFlags();
  options.verdict = VerdictFromFlags(options.minimizer);
  RequireFlag(FLAGS_map_voxel_m > 0 && std::isfinite(FLAGS_map_voxel_m), "map_voxel_m",
              Number(FLAGS_map_voxel_m), "a positive length");
  RequireFlag(FLAGS_map_radius_m > 0, "map_radius_m", Number(FLAGS_map_radius_m),
              "a positive length");
  RequireFlag(FLAGS_map_scans >= 0, "map_scans", std::to_string(FLAGS_map_scans), "0 or more");
  RequireFlag(FLAGS_map_every >= 1, "map_every", std::to_string(FLAGS_map_every), "at least 1");
  RequireFlag(FLAGS_adaptive_gate_m >= 0 && std::isfinite(FLAGS_adaptive_gate_m), "adaptive_gate_m",
              Number(FLAGS_adaptive_gate_m), "a length in m, or 0");
  options.map = {FLAGS_map_voxel_m, FLAGS_map_radius_m, FLAGS_map_scans};
  options.map_every = FLAGS_map_every;
  options.constant_velocity =
      IndexOfName("prediction", FLAGS_prediction, {"constant_velocity", "none"}) == 0;
  options.deskew = FromName<Deskewing>(FLAGS_deskew);
  options.adaptive_gate_m = FLAGS_adaptive_gate_m;
  options.threads = ThreadsFromFlags();
  options.Check();
  return options;
}

}  // namespace icpscape
