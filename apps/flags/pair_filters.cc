// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/pair_filters.h"

#include <gflags/gflags.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "apps/flags/filters.h"
#include "apps/run/flag.h"
#include "icpscape/common/error.h"
#include "icpscape/filtering/filter_statistics.h"
#include "icpscape/io/transform.h"

static const icpscape::FlagGroup group(__FILE__, "Predicted pose of the filters",
                                       icpscape::kNotOfDraws);

DEFINE_string(filter_estimate, "previous_motion",
              "Predicted pose of the filters: previous_motion (paper), identity, ground_truth, or "
              "the path of a text file of the 4x4 T_target_source.");

namespace icpscape {
namespace {

SE3d Estimate(const ScanPair& pair, Manifest* manifest) {
  if (FLAGS_filter_estimate == "identity") {
    return pair.origins.FromUser(SE3d());
  }
  if (FLAGS_filter_estimate == "ground_truth") {
    if (!pair.T_ground_truth) {
      throw UsageError("--filter_estimate=ground_truth: expected an input with a ground truth.");
    }
    return *pair.T_ground_truth;
  }
  if (FLAGS_filter_estimate == "previous_motion") {
    if (!pair.T_predicted) {
      throw UsageError(
          "--filter_estimate=previous_motion: expected true poses, and a scan before each of the "
          "two.");
    }
    return *pair.T_predicted;
  }
  manifest->AddInput(FLAGS_filter_estimate);
  return pair.origins.FromUser(ReadTransform(FLAGS_filter_estimate));
}

}  // namespace

void CheckFilterFlags() {
  FiltersFromFlags();
  RequireFlag(FLAGS_filter_estimate == "previous_motion" || FLAGS_filter_estimate == "identity" ||
                  FLAGS_filter_estimate == "ground_truth" ||
                  std::filesystem::is_regular_file(FLAGS_filter_estimate),
              "filter_estimate", FLAGS_filter_estimate,
              "previous_motion, identity, ground_truth or a file");
}

PreparedPair FilterFromFlags(const PreparedPair& scans, const ScanPair& pair, Manifest* manifest) {
  const FilterOptions options = FiltersFromFlags();
  if (!options.Any()) {
    return scans;
  }
  const SE3d T_predicted = options.NeedEstimate() ? Estimate(pair, manifest) : SE3d();
  const KeptPoints kept =
      ApplyFilters(scans.source.cloud(), scans.target.cloud(), T_predicted, options,
                   [&](const std::string& name, const KeptPoints& kept_here) {
                     const double source = CountKept(kept_here.source).Fraction();
                     const double target = CountKept(kept_here.target).Fraction();
                     std::printf("%s: keeps %.1f %% of the source, %.1f %% of the target\n",
                                 name.c_str(), 100 * source, 100 * target);
                     manifest->SetResult(name + "_kept_source", source);
                     manifest->SetResult(name + "_kept_target", target);
                   });
  return scans.Select(kept, ThreadsFromFlags());
}

}  // namespace icpscape
