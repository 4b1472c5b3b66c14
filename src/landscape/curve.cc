// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/landscape/curve.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"
#include "icpscape/common/text.h"
#include "icpscape/objective/pass.h"

namespace icpscape {
namespace {

// Central differences inside, one-sided of second order at the ends (of first order for two
// samples).
void SetNumericSlopes(std::vector<CurvePoint>* points) {
  std::vector<CurvePoint>& p = *points;
  const std::size_t last = p.size() - 1;
  const double h = (p[last].u - p[0].u) / static_cast<double>(last);
  if (last == 1) {
    p[0].slope_numeric = p[1].slope_numeric = (p[1].rmse - p[0].rmse) / h;
    return;
  }
  for (std::size_t i = 1; i < last; ++i) {
    p[i].slope_numeric = (p[i + 1].rmse - p[i - 1].rmse) / (2 * h);
  }
  p[0].slope_numeric = (-3 * p[0].rmse + 4 * p[1].rmse - p[2].rmse) / (2 * h);
  p[last].slope_numeric = (3 * p[last].rmse - 4 * p[last - 1].rmse + p[last - 2].rmse) / (2 * h);
}

// Adds back to eps what the metric's terms already leave out.
double LeftOut(const RegisteredMetric& metric, PatchOffset offset, long n) {
  if (metric.epsilon != Epsilon::kSoftNorm || offset == PatchOffset::kPerTerm) {
    return 0;
  }
  return static_cast<double>(offset == PatchOffset::kNone ? n : n - 1);
}

CurvePoint MakePoint(double u, const Evaluation& evaluation, std::size_t num_source_points,
                     const Vec6& body_twist) {
  CurvePoint point;
  point.u = u;
  point.epsilon = evaluation.epsilon;
  point.rmse = evaluation.Rmse();
  point.rms_residual = evaluation.RmsResidual();
  point.cost = evaluation.sums.cost;
  point.n = static_cast<double>(evaluation.n());
  point.inlier_ratio = point.n / static_cast<double>(num_source_points);
  // At a perfect fit the slope of a root is 0/0; the curve's own minimum has slope 0.
  point.slope_analytic = point.rmse > 0 ? evaluation.RmseSlope(body_twist) : 0;
  return point;
}

void SetRmseOfFixedN(std::vector<CurvePoint>* points) {
  const double n = std::min_element(points->begin(), points->end(),
                                    [](const CurvePoint& a, const CurvePoint& b) {
                                      return std::abs(a.u - 1) < std::abs(b.u - 1);
                                    })
                       ->n;
  for (CurvePoint& point : *points) {
    point.rmse_fixed_n = std::sqrt(point.epsilon / n);
  }
}

}  // namespace

CurveColumn CurveColumnFromName(const std::string& name) {
  std::vector<std::string> names;
  for (const CurveColumn& column : kCurveColumns) {
    names.emplace_back(column.name);
  }
  return kCurveColumns[IndexOfName("column", name, names)];
}

const CurvePoint& Curve::Minimum(double CurvePoint::*value) const {
  return *std::min_element(
      points.begin(), points.end(),
      [&](const CurvePoint& a, const CurvePoint& b) { return a.*value < b.*value; });
}

void CurveOptions::Check() const {
  constexpr int kMostSamples = 1000000;
  if (samples < 2 || samples > kMostSamples) {
    throw UsageError("samples " + std::to_string(samples) + ": expected at least 2, at most 1e6.");
  }
  if (!(std::abs(u_min) <= 1e6 && std::abs(u_max) <= 1e6 && u_min < u_max)) {
    throw UsageError("u from " + Number(u_min) + " to " + Number(u_max) +
                     ": expected u_min below u_max, within 1e6.");
  }
}

double CurveOptions::U(int index) const {
  // Symmetric in its ends, so that u = 0 and u = 1 are hit exactly where the grid has them.
  const int last = samples - 1;
  return (u_min * (last - index) + u_max * index) / last;
}

std::vector<Curve> EvaluateCurves(const std::vector<Objective>& objectives, const Path& path,
                                  const CurveOptions& options,
                                  const std::function<void(int)>& progress) {
  options.Check();
  std::vector<Curve> curves(objectives.size());
  for (std::size_t m = 0; m < objectives.size(); ++m) {
    curves[m].metric = objectives[m].metric().name;
    curves[m].points.resize(static_cast<std::size_t>(options.samples));
  }
  if (objectives.empty()) {
    return curves;
  }
  std::vector<const Objective*> all;
  for (const Objective& objective : objectives) {
    all.push_back(&objective);
  }
  MatchesByMatcher frozen;
  if (options.frozen_u) {
    frozen = MatchAll(all, path.Pose(*options.frozen_u), options.threads);
  }
  std::mutex mutex;
  int done = 0;
  ParallelFor(static_cast<std::size_t>(options.samples), options.threads, [&](std::size_t i) {
    const double u = options.U(static_cast<int>(i));
    const SE3d T_u = path.Pose(u);
    std::vector<Evaluation> evaluations =
        options.frozen_u ? EvaluateAll(all, T_u, frozen, Derivatives::kGradient, 1)
                         : EvaluateAll(all, T_u, Derivatives::kGradient, 1);
    for (std::size_t m = 0; m < objectives.size(); ++m) {
      Evaluation& evaluation = evaluations[m];
      if (evaluation.n() == 0) {
        throw ComputationError("no correspondence is left for " + objectives[m].metric().name +
                               " at u = " + Number(u) + ".");
      }
      evaluation.epsilon += LeftOut(objectives[m].metric(), options.patch_offset, evaluation.n());
      curves[m].points[i] =
          MakePoint(u, evaluation, objectives[m].matcher().source().size(), path.BodyTwist(u));
    }
    if (progress) {
      const std::lock_guard<std::mutex> lock(mutex);
      progress(++done);
    }
  });
  for (Curve& curve : curves) {
    SetNumericSlopes(&curve.points);
    SetRmseOfFixedN(&curve.points);
  }
  return curves;
}

}  // namespace icpscape
