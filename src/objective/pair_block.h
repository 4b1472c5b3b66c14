// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
#define ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_

#include <algorithm>
#include <optional>

#include "icpscape/matching/matcher.h"
#include "icpscape/objective/block_kernels.h"
#include "icpscape/residuals/correspondence.h"

namespace icpscape {

/// A run of source points in the matcher's order, with their matches and all that metrics need of
/// them: small enough to stay in the first-level cache while one metric after the other goes over
/// them.
class PairBlock {
 public:
  static constexpr std::size_t kCapacity = kBlockPairs;

  const BlockValues& values() const { return values_; }

  /// Takes the source points [begin, end) of the matcher's order, at most kCapacity. The match of
  /// point k is entry entry_of(k) of the matches. What `needs`, a union of Needs, has not is left
  /// out.
  template <class EntryOf>
  void Fill(const Matcher& matcher, const Matches& matches, std::size_t begin, std::size_t end,
            unsigned needs, const EntryOf& entry_of);

  /// The pair of the i-th of these points as metrics over double take it; nothing where there is
  /// no match, or no normal that is needed.
  std::optional<Correspondence> Pair(std::size_t i, unsigned needs) const;

 private:
  // What is the same for all pairs, by its kind.
  static const Mat3& OfMatching(const Matcher&, const Matches& matches, kind::Rotation) {
    return matches.T_target_source.R();
  }
  static double OfMatching(const Matcher& matcher, const Matches&, kind::Scalar) {
    return matcher.area_patch();
  }

  BlockValues values_ = {};
};

// In the header, because it is much of what a pass does besides the search.
template <class EntryOf>
void PairBlock::Fill(const Matcher& matcher, const Matches& matches, std::size_t begin,
                     std::size_t end, unsigned needs, const EntryOf& entry_of) {
  const SearchableCloud& target = matcher.searchable_target();
  const std::size_t size = values_.size = end - begin;
  std::size_t entry[kCapacity];
  std::size_t place[kCapacity];  // In the target; any point's where there is no match.
  for (std::size_t i = 0; i < size; ++i) {
    entry[i] = entry_of(begin + i);
    const std::int32_t j = matches.target_index[entry[i]];
    const std::int32_t found = j < 0 ? -1 : target.Place(static_cast<std::size_t>(j));
    values_.matched[i] = found < 0 ? 0.0F : 1.0F;
    place[i] = found < 0 ? 0 : static_cast<std::size_t>(found);
  }
  // Behind the last pair nothing counts.
  std::fill(values_.matched + size, values_.matched + kCapacity, 0.0F);
  ForEachQuantity<double>([&](auto row) {
    using Row = decltype(row);
    using Kind = typename Row::Kind;
    if (!Row::IsNeededBy(needs)) {
      return;
    }
    constexpr std::size_t kFirst = FirstNumber<Kind>(Row::kOrigin);
    for (std::size_t k = 0; k < Kind::kSize; ++k) {
      if constexpr (Row::kOrigin == Origin::kSourceCloud) {
        values_.source[kFirst + k] = matcher.searchable_source().Numbers(Kind())[k] + begin;
      } else if constexpr (Row::kOrigin == Origin::kTargetCloud) {
        const float* const from = target.Numbers(Kind())[k];
        for (std::size_t i = 0; i < size; ++i) {
          values_.target[kFirst + k][i] = from[place[i]];
        }
      } else if constexpr (Row::kOrigin == Origin::kFit) {
        for (std::size_t i = 0; i < size; ++i) {
          if (values_.matched[i] != 0) {
            values_.fit[kFirst + k][i] =
                Kind::template NumberOf<double>(matches.fits[entry[i]].Of(Kind()), k);
          }
        }
      } else {
        values_.matching[kFirst + k] =
            Kind::template NumberOf<double>(OfMatching(matcher, matches, Kind()), k);
      }
    }
  });
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
