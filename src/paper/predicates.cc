// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace icpscape {
namespace {

// The highest value passed from `begin` on in steps of `step` before one below `floor` is met.
double Barrier(const std::vector<double>& values, std::size_t begin, int step, double floor) {
  double highest = floor;
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  for (auto i = static_cast<std::ptrdiff_t>(begin); i >= 0 && i < size; i += step) {
    const double value = values[static_cast<std::size_t>(i)];
    if (value < floor) {
      break;
    }
    highest = std::max(highest, value);
  }
  return highest;
}

}  // namespace

double ArgminU(const Curve& curve) { return curve.Minimum().u; }

bool ArgminIsNear(const Curve& curve, double x) {
  return std::abs(ArgminU(curve) - x) <= kArgminTolerance + kSampleSlack;
}

double ValueAt(const Curve& curve, double u) {
  const std::vector<CurvePoint>& p = curve.points;
  const auto above = std::lower_bound(p.begin(), p.end(), u,
                                      [](const CurvePoint& a, double x) { return a.u < x; });
  if (above == p.begin()) {
    return p.front().rmse;
  }
  if (above == p.end()) {
    return p.back().rmse;
  }
  const CurvePoint& low = *(above - 1);
  const double part = (u - low.u) / (above->u - low.u);
  return low.rmse + part * (above->rmse - low.rmse);
}

std::vector<double> MedianOfThree(const Curve& curve) {
  std::vector<double> result;
  for (const CurvePoint& point : curve.points) {
    result.push_back(point.rmse);
  }
  for (std::size_t i = 1; i + 1 < result.size(); ++i) {
    const double a = curve.points[i - 1].rmse;
    const double b = curve.points[i].rmse;
    const double c = curve.points[i + 1].rmse;
    result[i] = std::max(std::min(a, b), std::min(std::max(a, b), c));
  }
  return result;
}

std::vector<LocalMinimum> LocalMinima(const Curve& curve) {
  const std::vector<double> value = MedianOfThree(curve);
  std::vector<LocalMinimum> minima;
  for (std::size_t begin = 1; begin + 1 < value.size();) {
    std::size_t end = begin;  // The last sample of a run of equal ones.
    while (end + 1 < value.size() && value[end + 1] == value[begin]) {
      ++end;
    }
    if (value[begin - 1] > value[begin] && end + 1 < value.size() && value[end + 1] > value[end]) {
      const auto first = curve.points.begin();
      const auto least = std::min_element(
          first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end) + 1,
          [](const CurvePoint& a, const CurvePoint& b) { return a.rmse < b.rmse; });
      const double barrier =
          std::min(Barrier(value, begin, -1, value[begin]), Barrier(value, end, 1, value[begin]));
      minima.push_back({least->u, least->rmse, barrier - value[begin]});
    }
    begin = end + 1;
  }
  return minima;
}

bool HasLocalMinimumNear(const Curve& curve, double x) {
  const std::vector<LocalMinimum> minima = LocalMinima(curve);
  return std::any_of(minima.begin(), minima.end(), [x](const LocalMinimum& minimum) {
    return std::abs(minimum.u - x) <= kLocalMinimumTolerance + kSampleSlack;
  });
}

double FlankSlope(const Curve& curve, double x) {
  const double middle = ValueAt(curve, x);
  return (ValueAt(curve, x - kFlankWidth) - middle + ValueAt(curve, x + kFlankWidth) - middle) /
         (2 * kFlankWidth);
}

bool DescendsMonotonically(const Curve& curve, double from_u, double to_u) {
  const std::vector<double> value = MedianOfThree(curve);
  double last = std::numeric_limits<double>::infinity();
  int samples = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const double u = curve.points[i].u;
    if (u < from_u - kSampleSlack || u > to_u + kSampleSlack) {
      continue;
    }
    if (value[i] > last) {
      return false;
    }
    last = value[i];
    ++samples;
  }
  return samples >= 2;
}

}  // namespace icpscape
