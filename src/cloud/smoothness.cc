// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/smoothness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "icpscape/cloud/rings.h"
#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"
#include "icpscape/common/text.h"
#include "icpscape/neighbors/neighbor_search.h"

namespace icpscape {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void Check(const SmoothnessOptions& options) {
  if (options.ring_points_per_side < 1) {
    throw UsageError("ring_points_per_side is " + std::to_string(options.ring_points_per_side) +
                     "; expected at least 1.");
  }
  if (options.num_neighbors < 1) {
    throw UsageError("smoothness num_neighbors is " + std::to_string(options.num_neighbors) +
                     "; expected at least 1.");
  }
  if (!(options.radius_m > 0) || !std::isfinite(options.radius_m)) {
    throw UsageError("smoothness radius_m is " + Number(options.radius_m) +
                     "; expected a length in metres above 0.");
  }
}

// s_i from the sums over the set: differences of the points, differences of their ranges.
double Formula(SmoothnessFormula formula, const Vec3& sum, double range_sum, std::size_t count,
               double range) {
  if (count == 0 || !(range > 0)) {
    return kNone;
  }
  switch (formula) {
    case SmoothnessFormula::kPrinted:
      return sum.norm() / (static_cast<double>(count) * range);
    case SmoothnessFormula::kALoam:
      return sum.squaredNorm();
    case SmoothnessFormula::kLioSam:
      return range_sum * range_sum;
  }
  return kNone;
}

// The sums over a set, one point after the other.
class Sums {
 public:
  Sums(const PointCloud& cloud, std::size_t i)
      : cloud_(cloud), point_(cloud.Point(i)), range_(Range(point_)) {}

  void Add(std::int32_t j) {
    const Vec3 other = cloud_.Point(static_cast<std::size_t>(j));
    sum_ += point_ - other;
    range_sum_ += range_ - Range(other);
    ++count_;
  }
  double Smoothness(SmoothnessFormula formula) const {
    return Formula(formula, sum_, range_sum_, count_, range_);
  }

 private:
  double Range(const Vec3& point) const { return (point - cloud_.sensor).norm(); }

  const PointCloud& cloud_;
  Vec3 point_;
  double range_;
  Vec3 sum_ = Vec3::Zero();
  double range_sum_ = 0;
  std::size_t count_ = 0;
};

void AlongRings(const PointCloud& cloud, const SmoothnessOptions& options, int threads,
                std::vector<double>* smoothness) {
  const std::vector<std::vector<std::int32_t>> rings = PointsByRing(cloud);
  const auto side = static_cast<std::size_t>(options.ring_points_per_side);
  ParallelFor(rings.size(), threads, [&](std::size_t r) {
    const std::vector<std::int32_t>& ring = rings[r];
    for (std::size_t k = side; k + side < ring.size(); ++k) {
      const auto i = static_cast<std::size_t>(ring[k]);
      Sums sums(cloud, i);
      for (std::size_t w = k - side; w <= k + side; ++w) {
        if (w != k) {
          sums.Add(ring[w]);
        }
      }
      (*smoothness)[i] = sums.Smoothness(options.formula);
    }
  });
}

void AmongNeighbors(const PointCloud& cloud, const SmoothnessOptions& options, int threads,
                    std::vector<double>* smoothness) {
  const NeighborSearch search(cloud.View(), threads);
  const bool by_count = options.neighborhood == SmoothnessNeighborhood::kKNearest;
  const auto wanted = static_cast<std::size_t>(by_count ? options.num_neighbors : 1);
  const std::vector<std::int32_t>& order = search.Order();
  if (wanted >= order.size()) {
    return;  // No point has so many others.
  }
  ForEachPart(order.size(), threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> nearest;
    std::vector<Neighbor> found;
    const std::size_t k = wanted + 1;
    if (by_count) {
      search.KNearest(search.OrderedPoints().Slice(begin, end), static_cast<int>(k), &nearest);
    }
    for (std::size_t place = begin; place < end; ++place) {
      const auto i = static_cast<std::size_t>(order[place]);
      if (by_count) {
        const auto first = nearest.begin() + static_cast<std::ptrdiff_t>((place - begin) * k);
        found.assign(first, std::find_if(first, first + static_cast<std::ptrdiff_t>(k),
                                         [](const Neighbor& n) { return n.index < 0; }));
      } else {
        search.WithinRadius(Eigen::Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]),
                            static_cast<float>(options.radius_m), &found);
      }
      Sums sums(cloud, i);
      std::size_t count = 0;
      for (const Neighbor& neighbor : found) {
        // Copies of the point may have pushed the point itself out of the k + 1.
        if (neighbor.index != static_cast<std::int32_t>(i) && (!by_count || count < wanted)) {
          sums.Add(neighbor.index);
          ++count;
        }
      }
      (*smoothness)[i] = count >= wanted ? sums.Smoothness(options.formula) : kNone;
    }
  });
}

}  // namespace

std::vector<double> ComputeSmoothness(const PointCloud& cloud, const SmoothnessOptions& options,
                                      int threads) {
  Check(options);
  std::vector<double> smoothness(cloud.size(), kNone);
  if (options.neighborhood == SmoothnessNeighborhood::kRing) {
    AlongRings(cloud, options, threads, &smoothness);
  } else {
    AmongNeighbors(cloud, options, threads, &smoothness);
  }
  return smoothness;
}

}  // namespace icpscape
