// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/joint.h"

#include <gflags/gflags.h>

#include <cmath>
#include <string>

#include "apps/flags/objective.h"
#include "apps/run/flag.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Several metrics at once");

DEFINE_string(weights, "",
              "Weights of the metrics, which are minimised together: numbers separated by commas. "
              "Without it every weight is 1.");

namespace icpscape {

std::vector<double> WeightsFromFlags() {
  std::vector<double> weights;
  for (const std::string& text : Split(FLAGS_weights)) {
    weights.push_back(ParseNumber(text));
    RequireFlag(weights.back() > 0 && std::isfinite(weights.back()), "weights", FLAGS_weights,
                "positive numbers");
  }
  RequireFlag(weights.empty() || weights.size() == MetricsFromFlags().size(), "weights",
              FLAGS_weights, "one weight per metric");
  return weights;
}

}  // namespace icpscape
