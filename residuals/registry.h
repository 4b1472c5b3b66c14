// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_REGISTRY_H_
#define ICPSCAPE_RESIDUALS_REGISTRY_H_

#include <string_view>
#include <type_traits>

#include "edge_to_line.h"
#include "planar_to_patch.h"
#include "point_to_plane.h"
#include "point_to_point.h"
#include "symmetric.h"

namespace icpscape {

template <class... Metrics>
struct MetricList {};

/// All metrics. A new metric adds its header above and its name here; flags, tables, landscapes and
/// solvers follow from this list.
using AllMetrics =
    MetricList<PointToPoint, PointToPlane, Symmetric, SymmetricRotated, SymmetricSplit, TwoPlane,
               EdgeToLine, EdgeToLineDistance, PlanarToPatch, PlanarToPlane>;

/// Passes a metric type to a call: decltype(tag)::Metric.
template <class M>
struct MetricTag {
  using Metric = M;
};

namespace internal {

template <class M>
constexpr void CheckMetric() {
  static_assert(std::is_aggregate_v<M>, "a metric is an aggregate of constants");
  static_assert(std::is_same_v<decltype(M::kEpsilon), const Epsilon>,
                "kEpsilon says what the plotted RMSE sums");
  static_assert(std::is_same_v<decltype(M::From(std::declval<Correspondence>())), M>,
                "a metric is made by From(correspondence)");
  static_assert(std::is_same_v<decltype(std::declval<const M&>().Residual(std::declval<SE3d>())),
                               Vec<double, M::kDim>>,
                "Residual(T) returns kDim rows");
  static_assert(std::is_same_v<decltype(std::declval<const M&>().Jacobian(std::declval<SE3d>())),
                               Mat<double, M::kDim, 6>>,
                "Jacobian(T) is kDim x 6");
}

template <class F, class... Metrics>
void ForEachMetric(MetricList<Metrics...>, F&& f) {
  (CheckMetric<Metrics>(), ...);
  (f(MetricTag<Metrics>{}), ...);
}

}  // namespace internal

/// Calls f(MetricTag<M>{}) for every metric, in the order of the list.
template <class F>
void ForEachMetric(F&& f) {
  internal::ForEachMetric(AllMetrics{}, f);
}

/// Calls f(MetricTag<M>{}) for the metric of that name; false if there is none.
template <class F>
bool WithMetric(std::string_view name, F&& f) {
  bool found = false;
  ForEachMetric([&](auto tag) {
    if (name == decltype(tag)::Metric::kName) {
      found = true;
      f(tag);
    }
  });
  return found;
}

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_REGISTRY_H_
