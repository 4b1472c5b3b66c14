// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/pull.h"

#include <array>
#include <functional>
#include <set>

#include "icpscape/cloud/label.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

using InGroup = std::function<bool(std::size_t point)>;

Evaluation OfGroup(const Objective& objective, const SE3d& T, Matches matches,
                   const InGroup& in_group, int threads) {
  for (std::size_t i = 0; i < matches.target_index.size(); ++i) {
    if (!in_group(i)) {
      matches.target_index[i] = -1;
    }
  }
  return objective.Evaluate(T, matches, threads);
}

}  // namespace

std::vector<Pull> Pulls(const Objective& objective, const SE3d& T_0, const SE3d& T_1, int threads) {
  const PointCloud& source = objective.matcher().source();
  const Matches matches_0 = objective.Match(T_0, threads);
  const Matches matches_1 = objective.Match(T_1, threads);
  std::vector<Pull> pulls;
  const auto add = [&](const std::string& group, const InGroup& in_group) {
    const Evaluation at_0 = OfGroup(objective, T_0, matches_0, in_group, threads);
    const Evaluation at_1 = OfGroup(objective, T_1, matches_1, in_group, threads);
    pulls.push_back({group, static_cast<double>(at_0.n()), at_0.epsilon,
                     static_cast<double>(at_1.n()), at_1.epsilon});
  };
  constexpr std::array<double, 6> kEdges_m = {0, 5, 10, 20, 40, 1e9};
  for (std::size_t bin = 0; bin + 1 < kEdges_m.size(); ++bin) {
    const double from_m = kEdges_m[bin];
    const double to_m = kEdges_m[bin + 1];
    add(bin + 2 < kEdges_m.size() ? Number(from_m) + " to " + Number(to_m) + " m"
                                  : "from " + Number(from_m) + " m",
        [&source, from_m, to_m](std::size_t i) {
          const double range_m = source.Point(i).norm();
          return range_m >= from_m && range_m < to_m;
        });
  }
  if (source.label.size() == source.size()) {
    std::set<int> classes;
    for (const std::int32_t label : source.label) {
      classes.insert(static_cast<int>(SemanticOf(label)));
    }
    for (const int semantic : classes) {
      add("label " + std::to_string(semantic), [&source, semantic](std::size_t i) {
        return static_cast<int>(SemanticOf(source.label[i])) == semantic;
      });
    }
  }
  return pulls;
}

}  // namespace icpscape
