// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/pair_block.h"

namespace icpscape {

std::optional<Correspondence> PairBlock::Pair(std::size_t i, unsigned needs) const {
  double weight = 0;
  const Correspondence pair = LoadPairs<double>(
      values_, i, needs, [](const auto* from) { return static_cast<double>(*from); }, &weight);
  return weight != 0 ? std::optional(pair) : std::nullopt;
}

}  // namespace icpscape
