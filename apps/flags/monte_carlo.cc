// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/monte_carlo.h"

#include <gflags/gflags.h>

#include "apps/flags/covariance.h"
#include "apps/flags/lidar.h"
#include "apps/flags/objective.h"
#include "apps/flags/preparation.h"
#include "apps/flags/starts.h"
#include "apps/run/flag.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/text.h"

DECLARE_string(scene);

static const icpscape::FlagGroup group(__FILE__, "Monte-Carlo draws");

DEFINE_int32(draws, 100,
             "With --scene: number of draws of scans and start; 0: only the report on the pair.");
DEFINE_string(sensor, "redrawn",
              "The lasers' constant errors: redrawn in every draw (the lidar is unknown), "
              "or fixed (always the lidar of --seed: its errors are bias).");

namespace icpscape {
namespace {

int DrawsFromFlags() {
  if (FLAGS_scene.empty()) {
    RequireFlag(FLAGS_draws == 0 || gflags::GetCommandLineFlagInfoOrDie("draws").is_default,
                "draws", std::to_string(FLAGS_draws),
                "0 without --scene, since only simulated scans can be drawn anew");
    return 0;
  }
  RequireFlag(FLAGS_draws == 0 || (FLAGS_draws >= 2 && FLAGS_draws <= 100000), "draws",
              std::to_string(FLAGS_draws), "0, or 2 to 100000");
  if (FLAGS_draws > 0) {
    RequireUnchanged([](const Flag& flag) { return flag.Has(kNotOfDraws); },
                     "--draws=0 with it, since draws do not apply it");
  }
  return FLAGS_draws;
}

}  // namespace

MonteCarloOptions MonteCarloFromFlags() {
  MonteCarloOptions options;
  options.scene = FLAGS_scene;
  options.seed = SeedFromFlags();
  options.lidar = LidarFromFlags();
  options.sensor = FromName<Sensor>(FLAGS_sensor);
  options.metrics = MetricsFromFlags();
  options.preparation = PreparationFromFlags(options.metrics);
  options.objective = ObjectiveSetFromFlags();
  options.start = StartsFromFlags();
  options.start.minimizer = PreciseMinimizer();
  options.covariance = CovarianceFromFlags();
  options.draws = DrawsFromFlags();
  options.threads = ThreadsFromFlags();
  return options;
}

}  // namespace icpscape
