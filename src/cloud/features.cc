// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/features.h"

#include <glog/logging.h>

#include <algorithm>
#include <string>

#include "icpscape/cloud/rings.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

constexpr std::size_t kFewFeatures = 500;

void Check(const FeatureOptions& options) {
  if (!(options.planar_below <= options.edge_from)) {
    throw UsageError("planar_below is " + Number(options.planar_below) + " and edge_from " +
                     Number(options.edge_from) + "; expected planar_below <= edge_from.");
  }
  const FeatureCaps& caps = options.caps;
  if (caps.regions_per_ring < 0 || caps.edges_per_region < 0 || caps.planar_per_region < 0) {
    throw UsageError("feature caps are " + std::to_string(caps.regions_per_ring) + ", " +
                     std::to_string(caps.edges_per_region) + " and " +
                     std::to_string(caps.planar_per_region) + "; expected 0 or more.");
  }
}

// Thins the classes of one ring to the caps.
class RingThinner {
 public:
  RingThinner(const std::vector<std::int32_t>& ring, const std::vector<double>& smoothness,
              const FeatureOptions& options)
      : ring_(ring), smoothness_(smoothness), options_(options), taken_(ring.size(), 0) {}

  void Thin(const Features& all, Features* kept) {
    const auto regions = static_cast<std::size_t>(options_.caps.regions_per_ring);
    for (std::size_t region = 0; region < regions; ++region) {
      const std::size_t begin = ring_.size() * region / regions;
      const std::size_t end = ring_.size() * (region + 1) / regions;
      Take(begin, end, all.edge, options_.caps.edges_per_region, true, &kept->edge);
      Take(begin, end, all.planar, options_.caps.planar_per_region, false, &kept->planar);
    }
  }

 private:
  void Take(std::size_t begin, std::size_t end, const std::vector<char>& candidate, int most,
            bool largest_first, std::vector<char>* kept) {
    std::vector<std::size_t> order;
    for (std::size_t k = begin; k < end; ++k) {
      if (candidate[Point(k)] != 0) {
        order.push_back(k);
      }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return largest_first ? smoothness_[Point(a)] > smoothness_[Point(b)]
                           : smoothness_[Point(a)] < smoothness_[Point(b)];
    });
    int count = 0;
    for (const std::size_t k : order) {
      if (count == most) {
        return;
      }
      if (IsFree(k)) {
        taken_[k] = 1;
        (*kept)[Point(k)] = 1;
        ++count;
      }
    }
  }

  bool IsFree(std::size_t k) const {
    const auto side = static_cast<std::size_t>(options_.smoothness.ring_points_per_side);
    const std::size_t first = k > side ? k - side : 0;
    const std::size_t last = std::min(ring_.size() - 1, k + side);
    for (std::size_t other = first; other <= last; ++other) {
      if (taken_[other] != 0) {
        return false;
      }
    }
    return true;
  }

  std::size_t Point(std::size_t k) const { return static_cast<std::size_t>(ring_[k]); }

  const std::vector<std::int32_t>& ring_;
  const std::vector<double>& smoothness_;
  const FeatureOptions& options_;
  std::vector<char> taken_;
};

std::size_t Count(const std::vector<char>& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
}

void WarnIfFew(const char* what, std::size_t count) {
  if (count < kFewFeatures) {
    LOG(WARNING) << count << " " << what << " points, fewer than " << kFewFeatures
                 << ": the smoothness, its threshold or the caps leave little to match.";
  }
}

}  // namespace

FeatureOptions ConventionalFeatureOptions(SmoothnessFormula formula) {
  FeatureOptions options;
  options.smoothness.formula = formula;
  options.edge_from = formula == SmoothnessFormula::kLioSam ? 1.0 : 0.1;
  return options;
}

Features Features::Select(const std::vector<char>& keep) const {
  Features selected;
  const auto select = [&](const std::vector<char>& from, std::vector<char>* to) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (keep[i] != 0) {
        to->push_back(from[i]);
      }
    }
  };
  select(edge, &selected.edge);
  select(planar, &selected.planar);
  selected.num_edge = Count(selected.edge);
  selected.num_planar = Count(selected.planar);
  return selected;
}

Features ExtractFeatures(const PointCloud& cloud, const FeatureOptions& options, int threads) {
  Check(options);
  const std::vector<double> smoothness = ComputeSmoothness(cloud, options.smoothness, threads);
  Features features{std::vector<char>(cloud.size(), 0), std::vector<char>(cloud.size(), 0)};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    features.edge[i] = smoothness[i] >= options.edge_from ? 1 : 0;  // Both are 0 for NaN.
    features.planar[i] = smoothness[i] < options.planar_below ? 1 : 0;
  }
  if (options.caps.regions_per_ring > 0) {
    Features kept{std::vector<char>(cloud.size(), 0), std::vector<char>(cloud.size(), 0)};
    for (const std::vector<std::int32_t>& ring : PointsByRing(cloud)) {
      RingThinner(ring, smoothness, options).Thin(features, &kept);
    }
    features = std::move(kept);
  }
  features.num_edge = Count(features.edge);
  features.num_planar = Count(features.planar);
  WarnIfFew("edge", features.num_edge);
  WarnIfFew("planar", features.num_planar);
  return features;
}

}  // namespace icpscape
