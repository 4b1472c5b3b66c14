// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/units.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "icpscape/neighbors/neighbor_search.h"

namespace icpscape {
namespace {

constexpr std::size_t kMostPoints = 1000;
constexpr double kLidarRangeM = 2000;
constexpr double kLidarSpacingM = 2;
constexpr double kLeastFactor = 300, kMostFactor = 3000;

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.empty() ? 0 : *middle;
}

std::vector<Vec3> SomePointsOf(const PointCloud& cloud) {
  std::vector<Vec3> points;
  const std::size_t every = 1 + cloud.size() / kMostPoints;
  for (std::size_t i = 0; i < cloud.size(); i += every) {
    points.push_back(cloud.Point(i));
  }
  return points;
}

double MedianRange(const std::vector<Vec3>& points) {
  Vec3 middle;
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const Vec3& p : points) {
      values.push_back(p[k]);
    }
    middle[k] = Median(values);
  }
  std::vector<double> ranges;
  for (const Vec3& p : points) {
    ranges.push_back((p - middle).norm());
  }
  return Median(ranges);
}

bool IsThousandfold(double a, double b) {
  return a >= kLeastFactor * b && a <= kMostFactor * b && b > 0;
}

}  // namespace

bool CloudScale::LooksLikeMillimetres() const {
  return range_m > kLidarRangeM && spacing_m > kLidarSpacingM;
}

bool CloudScale::IsThousandfold(const CloudScale& other) const {
  return icpscape::IsThousandfold(range_m, other.range_m) &&
         icpscape::IsThousandfold(spacing_m, other.spacing_m);
}

CloudScale RangeOf(const PointCloud& cloud) { return {MedianRange(SomePointsOf(cloud)), 0}; }

CloudScale ScaleOf(const PointCloud& cloud) {
  const std::vector<Vec3> points = SomePointsOf(cloud);
  const NeighborSearch search(cloud.View());
  std::vector<double> spacings;
  std::vector<Neighbor> neighbors;
  for (const Vec3& p : points) {
    search.KNearest(p.cast<float>().eval(), 2, &neighbors);
    if (neighbors.size() == 2) {
      spacings.push_back(std::sqrt(static_cast<double>(neighbors[1].squared_distance)));
    }
  }
  return {MedianRange(points), Median(spacings)};
}

}  // namespace icpscape
