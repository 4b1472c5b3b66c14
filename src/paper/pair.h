// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PAPER_PAIR_H_
#define ICPSCAPE_SRC_PAPER_PAIR_H_

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "src/cloud/features.h"
#include "src/cloud/point_cloud.h"
#include "src/landscape/curve.h"
#include "src/objective/objective_set.h"
#include "src/paper/figures.h"
#include "src/paper/pull.h"

namespace icpscape {

/// A pair of scans with all that the paper's metrics and filters ask of it.
struct PaperPair {
  PointCloud source;
  PointCloud target;
  Features features;  ///< Of the source.
  SE3d T_target_source;
  SE3d T_prior;  ///< The motion of the frame before: T_e of the filters.
};

/// Adds what the paper's five metrics need with its defaults: normals of 20 neighbours, and
/// features of five points to either side on the recovered rings.
void PrepareForMetrics(int threads, PaperPair* pair);

/// The pair after the variant's filters with this T_e, in the paper's sizes: radii of 5 m, voxels
/// of 0.1 m. Normals and features are those of the whole scans and stay with their points. Throws
/// ComputationError where a filter leaves nothing.
PaperPair Filtered(const PaperPair& pair, Variant variant, const SE3d& T_estimate);

/// The matching of the variant; fits and the rest as printed.
ObjectiveSetOptions OptionsOf(Variant variant);

/// A curve, and which points make it what it is.
struct PaperCurve {
  Curve curve;
  std::vector<Pull> pulls;
};

/// By file names; what two figures share is evaluated once. From the identity (u = 0) to the truth
/// (u = 1) along the paper's path. `progress` as in EvaluateCurves, over all variants.
std::map<std::string, PaperCurve> EvaluatePaperCurves(
    const PaperPair& pair, const std::vector<FigureCurve>& curves, const CurveOptions& options,
    const std::function<void(int)>& progress = nullptr);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PAPER_PAIR_H_
