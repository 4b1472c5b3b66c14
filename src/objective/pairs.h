// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_PAIRS_H_
#define ICPSCAPE_SRC_OBJECTIVE_PAIRS_H_

#include <optional>

#include "icpscape/objective/objective.h"

namespace icpscape {

/// Calls visit(source_index, target_index, pair) for every pair that the objective sums over under
/// these matches, in the matcher's order. For what is not worth a kernel of its own.
template <class Visit>
void ForEachPair(const Objective& objective, const Matches& matches, const Visit& visit) {
  const Matcher& matcher = objective.matcher();
  const std::vector<std::int32_t>& order = matcher.Order();
  const auto source_index = [&](std::size_t k) { return static_cast<std::size_t>(order[k]); };
  PairBlock block;
  for (std::size_t begin = 0; begin < order.size(); begin += PairBlock::kCapacity) {
    const std::size_t end = std::min(order.size(), begin + PairBlock::kCapacity);
    block.Fill(matcher, matches, begin, end, objective.needs(), source_index);
    for (std::size_t k = begin; k < end; ++k) {
      if (const std::optional<Correspondence> pair = block.Pair(k - begin, objective.needs())) {
        const std::size_t i = source_index(k);
        visit(i, static_cast<std::size_t>(matches.target_index[i]), *pair);
      }
    }
  }
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_PAIRS_H_
