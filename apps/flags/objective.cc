// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/objective.h"

#include <gflags/gflags.h>

#include "apps/flags/local_fit.h"
#include "apps/flags/matching.h"
#include "apps/run/flag.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/text.h"
#include "icpscape/objective/loss.h"

static const icpscape::FlagGroup group(__FILE__, "Metrics and loss");

DEFINE_string(metrics, "point_to_point,point_to_plane,symmetric",
              "Metrics, separated by commas; icpscape-list_metrics names them.");
static const icpscape::FlagMark metrics_mark(&FLAGS_metrics, icpscape::kShown);
DEFINE_string(loss, "none",
              "Loss on each residual: none, huber, soft_l_one, cauchy, arctan, tukey, tolerant. "
              "With none planar_to_patch keeps its own, SoftLOneLoss(1). A loss changes the "
              "cost, but not the paper's RMSE.");
static const icpscape::FlagMark loss_mark(&FLAGS_loss, icpscape::kCostOnly);
DEFINE_double(loss_scale_m, 0.1, "Length at which the loss bends (m).");
static const icpscape::FlagMark loss_scale_mark(&FLAGS_loss_scale_m, icpscape::kCostOnly);

namespace icpscape {

std::vector<std::string> MetricsFromFlags() {
  std::vector<std::string> metrics = Split(FLAGS_metrics);
  RequireFlag(!metrics.empty() && Join(metrics, ",") == FLAGS_metrics, "metrics", FLAGS_metrics,
              "at least one metric, separated by single commas");
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    MetricNamed(metrics[i]);  // Throws for an unknown one.
    for (std::size_t j = 0; j < i; ++j) {
      RequireFlag(metrics[i] != metrics[j], "metrics", FLAGS_metrics, "each metric once");
    }
  }
  return metrics;
}

ObjectiveSetOptions ObjectiveSetFromFlags() {
  ObjectiveSetOptions options;
  options.matching = MatchingFromFlags();
  options.loss = MakeLoss(FLAGS_loss, FLAGS_loss_scale_m);
  options.line = LocalFitFromFlags();
  options.patch = options.line;
  return options;
}

}  // namespace icpscape
