// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/rejection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"
#include "icpscape/common/text.h"
#include "icpscape/neighbors/moved_points.h"

namespace icpscape {
namespace {

constexpr std::int32_t kNone = -1;

void Require(bool good, const char* name, double value, const char* expected) {
  if (!good) {
    throw UsageError(std::string(name) + " is " + Number(value) + "; expected " + expected + ".");
  }
}

struct Pair {
  std::size_t source;
  double distance_m;
};

// The pairs in the order of the source.
std::vector<Pair> PairsOf(const PointCloud& source, const PointCloud& target,
                          const SE3d& T_target_source, const Matches& matches) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < matches.target_index.size(); ++i) {
    const std::int32_t j = matches.target_index[i];
    if (j != kNone) {
      const Vec3 q = target.Point(static_cast<std::size_t>(j));
      pairs.push_back({i, (T_target_source * source.Point(i) - q).norm()});
    }
  }
  return pairs;
}

void RejectBeyond(const std::vector<Pair>& pairs, double max_distance_m, Matches* matches) {
  for (const Pair& pair : pairs) {
    if (pair.distance_m > max_distance_m) {
      matches->target_index[pair.source] = kNone;
    }
  }
}

// The lower of the two middle values; not empty.
double LowerMedian(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void RejectNotReciprocal(const SearchableCloud& source, const PointCloud& target,
                         const SE3d& T_target_source, double epsilon_m, int threads,
                         Matches* matches) {
  Require(epsilon_m >= 0 && std::isfinite(epsilon_m), "epsilon_m", epsilon_m,
          "a length, 0 for the strict form");
  const SE3d T_source_target = T_target_source.Inverse();
  const std::vector<std::int32_t>& order = source.search().Order();
  ForEachPart(order.size(), threads, [&](std::size_t begin, std::size_t end) {
    PointCloud matched;  // The matches of near points are near each other.
    std::vector<std::size_t> whose;
    for (std::size_t k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(order[k]);
      if (matches->target_index[i] != kNone) {
        const auto j = static_cast<std::size_t>(matches->target_index[i]);
        matched.x.push_back(target.x[j]);
        matched.y.push_back(target.y[j]);
        matched.z.push_back(target.z[j]);
        whose.push_back(i);
      }
    }
    MovedPoints back;
    back.Move(T_source_target, matched.View());
    std::vector<std::int32_t> nearest(whose.size());
    std::vector<float> squared_distance(whose.size());
    source.search().Nearest(back.View(), std::numeric_limits<float>::max(), nearest.data(),
                            squared_distance.data());
    for (std::size_t m = 0; m < whose.size(); ++m) {
      const std::size_t i = whose[m];
      const auto k = static_cast<std::size_t>(nearest[m]);
      if (nearest[m] < 0) {
        matches->target_index[i] = kNone;  // Too far away to be near anything.
      } else if (k != i &&
                 !((source.cloud().Point(i) - source.cloud().Point(k)).norm() <= epsilon_m)) {
        matches->target_index[i] = kNone;
      }
    }
  });
}

void RejectDistant(const PointCloud& source, const PointCloud& target, const SE3d& T_target_source,
                   double max_distance_m, Matches* matches) {
  Require(max_distance_m > 0, "max_distance_m", max_distance_m, "a length above 0");
  RejectBeyond(PairsOf(source, target, T_target_source, *matches), max_distance_m, matches);
}

void RejectByNormalAngle(const PointCloud& source, const PointCloud& target,
                         const SE3d& T_target_source, double max_angle_rad, Matches* matches) {
  Require(max_angle_rad >= 0 && max_angle_rad <= M_PI, "max_angle_rad", max_angle_rad,
          "an angle from 0 to pi");
  if (!source.has_normals() || !target.has_normals()) {
    throw InputError(std::string("the ") + (source.has_normals() ? "target" : "source") +
                     " has no normals; expected them for rejection by their angle.");
  }
  for (std::size_t i = 0; i < matches->target_index.size(); ++i) {
    const std::int32_t match = matches->target_index[i];
    if (match == kNone) {
      continue;
    }
    const auto j = static_cast<std::size_t>(match);
    bool keep = source.NormalIsValid(i) && target.NormalIsValid(j);
    if (keep) {
      // From sine and cosine: exact for small angles, and float normals need not be of length 1.
      const Vec3 n = T_target_source.R() * source.Normal(i);
      const Vec3 m = target.Normal(j);
      keep = std::atan2(n.cross(m).norm(), n.dot(m)) <= max_angle_rad;
    }
    if (!keep) {
      matches->target_index[i] = kNone;
    }
  }
}

void RejectBeyondMedian(const PointCloud& source, const PointCloud& target,
                        const SE3d& T_target_source, double factor, Matches* matches) {
  Require(factor > 0, "the median distance's factor", factor, "a number above 0");
  const std::vector<Pair> pairs = PairsOf(source, target, T_target_source, *matches);
  if (pairs.empty()) {
    return;
  }
  std::vector<double> distances;
  for (const Pair& pair : pairs) {
    distances.push_back(pair.distance_m);
  }
  RejectBeyond(pairs, factor * LowerMedian(std::move(distances)), matches);
}

void RejectTrimmed(const PointCloud& source, const PointCloud& target, const SE3d& T_target_source,
                   double kept_fraction, Matches* matches) {
  Require(kept_fraction >= 0 && kept_fraction <= 1, "kept_fraction", kept_fraction,
          "a share from 0 to 1");
  std::vector<Pair> pairs = PairsOf(source, target, T_target_source, *matches);
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.distance_m < b.distance_m || (a.distance_m == b.distance_m && a.source < b.source);
  });
  const auto kept =
      static_cast<std::size_t>(std::llround(kept_fraction * static_cast<double>(pairs.size())));
  for (std::size_t rank = kept; rank < pairs.size(); ++rank) {
    matches->target_index[pairs[rank].source] = kNone;
  }
}

void RejectRegions(const PointCloud& source, const PointCloud& target, const SE3d& T_target_source,
                   const RegionOptions& options, Matches* matches) {
  Require(options.region_size_m > 0 && std::isfinite(options.region_size_m), "region_size_m",
          options.region_size_m, "a length above 0");
  Require(options.median_factor > 0, "median_factor", options.median_factor, "a number above 0");
  using Region = std::array<double, 3>;
  struct Members {
    std::vector<std::size_t> source;
    double sum_m = 0;
    double Mean() const { return sum_m / static_cast<double>(source.size()); }
  };
  std::map<Region, Members> regions;
  for (const Pair& pair : PairsOf(source, target, T_target_source, *matches)) {
    const Vec3 p = source.Point(pair.source) / options.region_size_m;
    Members& members = regions[{std::floor(p.x()), std::floor(p.y()), std::floor(p.z())}];
    members.source.push_back(pair.source);
    members.sum_m += pair.distance_m;
  }
  if (regions.empty()) {
    return;
  }
  std::vector<double> means;
  for (const auto& [region, members] : regions) {
    means.push_back(members.Mean());
  }
  const double largest_m = options.median_factor * LowerMedian(std::move(means));
  for (const auto& [region, members] : regions) {
    if (members.Mean() > largest_m) {
      for (const std::size_t i : members.source) {
        matches->target_index[i] = kNone;
      }
    }
  }
}

}  // namespace icpscape
