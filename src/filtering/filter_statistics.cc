// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/filtering/filter_statistics.h"

#include <cmath>
#include <limits>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double KeptCount::Fraction() const { return Share(kept, points); }

double RemovalScore::Precision() const { return Share(dynamic_removed, removed); }

double RemovalScore::Recall() const { return Share(dynamic_removed, dynamic); }

KeptCount CountKept(const std::vector<char>& keep) {
  KeptCount count{keep.size(), 0};
  for (const char k : keep) {
    count.kept += k != 0 ? 1 : 0;
  }
  return count;
}

std::vector<RangeBin> KeptByRange(const PointCloud& cloud, const std::vector<char>& keep,
                                  double bin_m) {
  if (!(bin_m > 0) || !std::isfinite(bin_m)) {
    throw UsageError("the range bins are " + Number(bin_m) + " m wide; expected a length above 0.");
  }
  std::vector<RangeBin> bins;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto bin = static_cast<std::size_t>(cloud.Point(i).norm() / bin_m);
    while (bins.size() <= bin) {
      const auto index = static_cast<double>(bins.size());
      bins.push_back({index * bin_m, (index + 1) * bin_m, {}});
    }
    ++bins[bin].count.points;
    bins[bin].count.kept += keep[i] != 0 ? 1 : 0;
  }
  return bins;
}

RemovalScore ScoreRemoval(const PointCloud& cloud, const std::vector<char>& keep,
                          const std::function<bool(std::int32_t label)>& is_dynamic) {
  if (cloud.label.size() != cloud.size()) {
    throw InputError("the cloud has no labels; expected one for each of its " +
                     std::to_string(cloud.size()) + " points.");
  }
  RemovalScore score;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool dynamic = is_dynamic(cloud.label[i]);
    const bool removed = keep[i] == 0;
    score.removed += removed ? 1 : 0;
    score.dynamic += dynamic ? 1 : 0;
    score.dynamic_removed += removed && dynamic ? 1 : 0;
  }
  return score;
}

}  // namespace icpscape
