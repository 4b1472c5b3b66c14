// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PAPER_PAPER_CURVES_H_
#define ICPSCAPE_SRC_PAPER_PAPER_CURVES_H_

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "icpscape/landscape/curve.h"
#include "icpscape/objective/objective_set.h"
#include "icpscape/paper/figures.h"
#include "icpscape/paper/pull.h"

namespace icpscape {

/// The scans of a pair with what the paper's five metrics need, by its defaults: normals of 20
/// neighbours, and features of five points to either side on the recovered rings.
PreparedPair PrepareForPaper(PointCloud source, PointCloud target, int threads);

/// The scans after the variant's filters with this predicted pose, in the paper's sizes: radii of 5
/// m, voxels of 0.1 m. Normals and features are those of the whole scans and stay with their
/// points. Throws ComputationError where a filter leaves nothing.
PreparedPair Filtered(const PreparedPair& scans, Variant variant, const SE3d& T_estimate,
                      int threads);

/// The matching of the variant; fits and the rest as printed.
ObjectiveSetOptions OptionsOf(Variant variant);

/// A curve, and which points make it what it is.
struct PaperCurve {
  Curve curve;
  std::vector<Pull> pulls;
};

/// By file names; what two figures share is evaluated once. From the identity (u = 0) to the truth
/// (u = 1) along the paper's path; the filters use `T_predicted`. `progress` as in EvaluateCurves,
/// over all variants.
std::map<std::string, PaperCurve> EvaluatePaperCurves(
    const PreparedPair& scans, const SE3d& T_ground_truth, const SE3d& T_predicted,
    const std::vector<FigureCurve>& curves, const CurveOptions& options,
    const std::function<void(int)>& progress = nullptr);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PAPER_PAPER_CURVES_H_
