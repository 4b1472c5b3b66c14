// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/preset.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "apps/flags/objective.h"
#include "apps/run/flag.h"

static const icpscape::FlagGroup group(__FILE__, "Preset");

DEFINE_string(preset, "paper",
              "paper (one loop over the objective of the flags) or robust (all pairs first, then a "
              "gate that shrinks with the residuals, Huber's loss, normals of 10 neighbours: for "
              "clouds that overlap in part, and starts that are far off).");

namespace icpscape {

Preset PresetFromFlags() {
  const auto preset = FromName<Preset>(FLAGS_preset);
  if (preset == Preset::kRobust) {
    static const std::set<std::string> kItsOwn = {"max_distance_m", "loss", "loss_scale_m",
                                                  "reassociation"};
    RequireUnchanged([](const Flag& flag) { return kItsOwn.count(flag.name) > 0; },
                     "its default with --preset=robust, which finds gate and loss by itself");
    const std::vector<std::string> metrics = MetricsFromFlags();
    const auto of_features = std::find_if(metrics.begin(), metrics.end(), NeedsFeatures);
    RequireFlag(of_features == metrics.end(), "preset", FLAGS_preset,
                "paper with " + (of_features == metrics.end() ? "" : *of_features) +
                    ", whose edge or planar points have no gate");
    SetFlagDefault("normal_neighbors", std::to_string(kRobustNormalNeighbors));
  }
  return preset;
}

}  // namespace icpscape
