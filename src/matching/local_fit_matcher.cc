// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/local_fit_matcher.h"

#include <algorithm>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/neighbors/moved_points.h"

namespace icpscape {

LocalFitMatcher::LocalFitMatcher(Shape shape, SearchableCloud source, SearchableCloud target,
                                 const LocalFitOptions& options)
    : Matcher(std::move(source), std::move(target)), shape_(shape), options_(options) {
  if (options.num_neighbors < 3) {
    throw UsageError("neighbours of a fit " + std::to_string(options.num_neighbors) +
                     ": expected at least 3.");
  }
  if (!(options.triangle_leg_m > 0)) {
    throw UsageError("legs of the patch's triangle " + Number(options.triangle_leg_m) +
                     " m: expected a positive length.");
  }
}

bool LocalFitMatcher::Accepts(const Neighborhoods& neighborhoods, const PrincipalAxes& axes,
                              std::size_t i) const {
  if (neighborhoods.count[i] < options_.num_neighbors) {
    return false;
  }
  const double gate = options_.max_neighbor_distance_m;
  if (gate > 0 && neighborhoods.farthest_squared_distance[i] > gate * gate) {
    return false;
  }
  const double n = neighborhoods.count[i];
  const double divisor = options_.eigenvalue_scale == EigenvalueScale::kOverN           ? n
                         : options_.eigenvalue_scale == EigenvalueScale::kOverNMinusOne ? n - 1
                                                                                        : 1;
  const double smallest = std::max(0.0, axes.smallest[i]) / divisor;
  const double middle = std::max(0.0, axes.middle[i]) / divisor;
  const double largest = std::max(0.0, axes.largest[i]) / divisor;
  return shape_ == Shape::kLine ? largest > options_.eigenvalue_ratio * middle
                                : middle > options_.eigenvalue_ratio * smallest &&
                                      smallest < options_.max_smallest_eigenvalue_m2;
}

void LocalFitMatcher::FindPart(const SE3d& T, std::size_t begin, std::size_t end,
                               Matches* matches) const {
  thread_local MovedPoints moved;
  thread_local Neighborhoods neighborhoods;
  thread_local PrincipalAxes axes;
  moved.Move(T, searchable_source().search().OrderedPoints().Slice(begin, end));
  const PointsView queries = moved.View();
  searchable_target().search().KNearest(queries, options_.num_neighbors, &neighborhoods);
  neighborhoods.CenterProducts();
  axes.Compute(neighborhoods);
  matches->target_index.resize(queries.size);
  matches->fits.resize(queries.size);
  for (std::size_t i = 0; i < queries.size; ++i) {
    const bool accepted = Accepts(neighborhoods, axes, i);
    matches->target_index[i] = accepted ? neighborhoods.nearest[i] : -1;
    if (accepted) {
      const Vec3 query(queries.x[i], queries.y[i], queries.z[i]);
      matches->fits[i].anchor =
          options_.anchor == FitAnchor::kCentroid
              ? Vec3(query + neighborhoods.Mean(i))
              : target().Point(static_cast<std::size_t>(neighborhoods.nearest[i]));
      matches->fits[i].direction = shape_ == Shape::kLine ? axes.Largest(i) : axes.Smallest(i);
    }
  }
}

}  // namespace icpscape
