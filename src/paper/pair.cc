// SPDX-License-Identifier: BSD-3-Clause
#include "src/paper/pair.h"

#include <utility>

#include "src/cloud/normals.h"
#include "src/cloud/rings.h"
#include "src/common/error.h"
#include "src/filtering/ego_blind_spot.h"
#include "src/filtering/octree_correspondence_filter.h"

namespace icpscape {
namespace {

void KeepWhere(const std::vector<char>& keep, std::vector<char>* mask) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mask->size(); ++i) {
    if (keep[i] != 0) {
      (*mask)[kept++] = (*mask)[i];
    }
  }
  mask->resize(kept);
}

void Apply(const std::string& name, FilteredPair filtered, PaperPair* pair) {
  if (filtered.source.empty() || filtered.target.empty()) {
    throw ComputationError(name + ": no point is left; expected some to agree.");
  }
  KeepWhere(filtered.keep_source, &pair->features.edge);
  KeepWhere(filtered.keep_source, &pair->features.planar);
  pair->source = std::move(filtered.source);
  pair->target = std::move(filtered.target);
}

}  // namespace

void PrepareForMetrics(int threads, PaperPair* pair) {
  EstimateNormals({}, threads, &pair->source);
  EstimateNormals({}, threads, &pair->target);
  RecoverRings(&pair->source);
  pair->features = ExtractFeatures(
      pair->source, ConventionalFeatureOptions(SmoothnessFormula::kPrinted), threads);
}

PaperPair Filtered(const PaperPair& pair, Variant variant, const SE3d& T_estimate) {
  PaperPair result = pair;
  if (variant == Variant::kBlindSpot || variant == Variant::kEgoFilter) {
    Apply("artificial blind spot",
          ArtificialBlindSpots(result.source, result.target, kEgoBlindSpotRadius_m), &result);
  }
  if (variant == Variant::kEgoFilter) {
    Apply("ego blind spot filter",
          EgoBlindSpotFilter(result.source, result.target, T_estimate, kEgoBlindSpotRadius_m),
          &result);
  }
  if (variant == Variant::kOctree) {
    Apply("Octree Correspondence Filter",
          OctreeCorrespondenceFilter(result.source, result.target, T_estimate, {}), &result);
  }
  return result;
}

ObjectiveSetOptions OptionsOf(Variant variant) {
  ObjectiveSetOptions options;
  if (variant == Variant::kReciprocal) {
    options.matching.reciprocal_epsilon_m = 0;
  }
  return options;
}

std::map<std::string, PaperCurve> EvaluatePaperCurves(const PaperPair& pair,
                                                      const std::vector<FigureCurve>& curves,
                                                      const CurveOptions& options,
                                                      const std::function<void(int)>& progress) {
  std::map<Variant, std::map<std::string, std::string>> files;  // By metric.
  for (const FigureCurve& curve : curves) {
    files[curve.variant][curve.metric] = curve.file;
  }
  const Path path(SE3d(), pair.T_target_source, PathKind::kLerpSlerp);
  std::map<std::string, PaperCurve> result;
  int done_before = 0;
  for (const auto& [variant, file_of_metric] : files) {
    std::vector<std::string> metrics;
    for (const auto& entry : file_of_metric) {
      metrics.push_back(entry.first);
    }
    const PaperPair filtered = Filtered(pair, variant, pair.T_prior);
    const ObjectiveSet set(filtered.source, filtered.target, filtered.features, metrics,
                           OptionsOf(variant));
    std::vector<Curve> drawn = EvaluateCurves(set.objectives(), path, options, [&](int done) {
      if (progress) {
        progress(done_before + done);
      }
    });
    done_before += options.samples;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const Objective& objective = set.objectives()[i];
      PaperCurve& entry = result[file_of_metric.at(objective.metric())];
      entry.curve = std::move(drawn[i]);
      entry.pulls = Pulls(objective, path.Pose(0), path.Pose(1), options.threads);
    }
  }
  return result;
}

}  // namespace icpscape
