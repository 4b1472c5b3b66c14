// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
#define ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_

#include <array>

#include "residuals/correspondence.h"
#include "src/matching/matcher.h"

namespace icpscape {

/// A few matched pairs with all that some metrics need of them: small enough to stay in the
/// first-level cache while one metric after the other goes over them.
struct PairBlock {
  static constexpr std::size_t kCapacity = 64;

  std::array<Correspondence, kCapacity> pairs;
  /// Which Needs the pair meets: a normal may be missing.
  std::array<unsigned, kCapacity> provided;
  std::size_t size = 0;

  /// Adds source point i with the match that is entry m of the matches; nothing where there is
  /// none. Of what `needs` does not ask for, nothing is looked up.
  void Add(const Matcher& matcher, const Matches& matches, std::size_t m, std::size_t i,
           unsigned needs);
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
