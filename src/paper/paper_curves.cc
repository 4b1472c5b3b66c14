// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/paper_curves.h"

#include <utility>

#include "icpscape/filtering/ego_blind_spot.h"
#include "icpscape/filtering/filter_chain.h"
#include "icpscape/filtering/octree_correspondence_filter.h"

namespace icpscape {
namespace {

FilterOptions FiltersOf(Variant variant) {
  FilterOptions options;
  if (variant == Variant::kBlindSpot || variant == Variant::kEgoFilter) {
    options.artificial_blind_spot_m = kEgoBlindSpotRadius_m;
  }
  if (variant == Variant::kEgoFilter) {
    options.ego_blind_spot_m = kEgoBlindSpotRadius_m;
  }
  if (variant == Variant::kOctree) {
    options.octree_voxel_m = OctreeFilterOptions().voxel_size_m;
  }
  return options;
}

}  // namespace

PreparedPair PrepareForPaper(PointCloud source, PointCloud target, int threads) {
  PreparationOptions options;
  options.features = ConventionalFeatureOptions(SmoothnessFormula::kPrinted);
  return PreparePair(std::move(source), std::move(target),
                     kSourceNormal | kTargetNormal | kTargetLine | kTargetPatch, options, threads);
}

PreparedPair Filtered(const PreparedPair& scans, Variant variant, const SE3d& T_estimate,
                      int threads) {
  const FilterOptions filters = FiltersOf(variant);
  return filters.Any() ? scans.Select(ApplyFilters(scans.source.cloud(), scans.target.cloud(),
                                                   T_estimate, filters),
                                      threads)
                       : scans;
}

ObjectiveSetOptions OptionsOf(Variant variant) {
  ObjectiveSetOptions options;
  if (variant == Variant::kReciprocal) {
    options.matching.reciprocal_epsilon_m = 0;
  }
  return options;
}

std::map<std::string, PaperCurve> EvaluatePaperCurves(const PreparedPair& scans,
                                                      const SE3d& T_ground_truth,
                                                      const SE3d& T_predicted,
                                                      const std::vector<FigureCurve>& curves,
                                                      const CurveOptions& options,
                                                      const std::function<void(int)>& progress) {
  std::map<Variant, std::map<std::string, std::string>> files;  // By metric.
  for (const FigureCurve& curve : curves) {
    files[curve.variant][curve.metric] = curve.file;
  }
  const Path path(SE3d(), T_ground_truth, PathKind::kLerpSlerp, scans.source.cloud().sensor);
  std::map<std::string, PaperCurve> result;
  int done_before = 0;
  for (const auto& [variant, file_of_metric] : files) {
    std::vector<std::string> metrics;
    for (const auto& entry : file_of_metric) {
      metrics.push_back(entry.first);
    }
    const ObjectiveSet set(Filtered(scans, variant, T_predicted, options.threads), metrics,
                           OptionsOf(variant));
    std::vector<Curve> drawn = EvaluateCurves(set.objectives(), path, options, [&](int done) {
      if (progress) {
        progress(done_before + done);
      }
    });
    done_before += options.samples;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const Objective& objective = set.objectives()[i];
      PaperCurve& entry = result[file_of_metric.at(objective.metric().name)];
      entry.curve = std::move(drawn[i]);
      entry.pulls = Pulls(objective, path.Pose(0), path.Pose(1), options.threads);
    }
  }
  return result;
}

}  // namespace icpscape
