// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_LANDSCAPE_CURVE_H_
#define ICPSCAPE_SRC_LANDSCAPE_CURVE_H_

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/landscape/path.h"
#include "icpscape/objective/objective.h"

namespace icpscape {

/// One sample of the open loop: the objective at T_u.
struct CurvePoint {
  double u = 0;
  double rmse = 0;            ///< sqrt(eps / n), eps as the paper prints it.
  double epsilon = 0;         ///< eps itself.
  double rmse_fixed_n = 0;    ///< sqrt(eps / n(u = 1)): the denominator does not move with u.
  double rms_residual = 0;    ///< sqrt(sum |r|^2 / n).
  double cost = 0;            ///< 1/2 sum rho(|r|^2), what the solver minimises.
  double n = 0;               ///< Pairs that took part.
  double inlier_ratio = 0;    ///< n over the number of source points.
  double slope_analytic = 0;  ///< d rmse / du from the objective's gradient and the body twist.
  double slope_numeric = 0;   ///< d rmse / du of the plotted curve, by differences of its samples.
};

/// What can be drawn over u: the ways to read the paper's RMSE(eps), and the raw sums.
struct CurveColumn {
  const char* name;
  double CurvePoint::*value;
};
inline constexpr CurveColumn kCurveColumns[] = {
    {"rmse", &CurvePoint::rmse},
    {"rms_residual", &CurvePoint::rms_residual},
    {"rmse_fixed_n", &CurvePoint::rmse_fixed_n},
    {"epsilon", &CurvePoint::epsilon},
    {"cost", &CurvePoint::cost},
    {"inlier_ratio", &CurvePoint::inlier_ratio},
};
/// Throws UsageError for a name that is not in kCurveColumns.
CurveColumn CurveColumnFromName(const std::string& name);

/// What is subtracted from planar_to_patch's sum, "since the metric becomes one" at a match [paper
/// sec. 4.2]: one from each term, one from the whole, or nothing.
enum class PatchOffset { kPerTerm, kTotal, kNone };
template <>
struct Names<PatchOffset> {
  static constexpr const char* kWhat = "patch offset";
  static constexpr const char* kNames[] = {"per_term", "total", "none"};
};

/// The objective of one metric along a path.
struct Curve {
  std::string metric;
  std::vector<CurvePoint> points;

  /// The sample of least value (the first of several); points must not be empty.
  const CurvePoint& Minimum(double CurvePoint::*value = &CurvePoint::rmse) const;
};

struct CurveOptions {
  double u_min = -1;
  double u_max = 2;
  int samples = 100;  ///< Both ends included.
  int threads = 1;
  /// Where set, all poses are evaluated with the matches of this u instead of being re-associated.
  std::optional<double> frozen_u;
  PatchOffset patch_offset = PatchOffset::kPerTerm;

  /// Throws UsageError for fewer than two samples or an empty interval.
  void Check() const;
  double U(int index) const;
};

/// Evaluates all objectives along the path, in parallel over poses; bit-identical for any number of
/// threads. Objectives that share a matcher share its work. `progress` (if any) is called with the
/// number of poses done, from any thread but one at a time.
/// Throws ComputationError where a pose leaves a metric without correspondences.
std::vector<Curve> EvaluateCurves(const std::vector<Objective>& objectives, const Path& path,
                                  const CurveOptions& options,
                                  const std::function<void(int)>& progress = nullptr);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_LANDSCAPE_CURVE_H_
