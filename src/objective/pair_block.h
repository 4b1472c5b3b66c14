// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
#define ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_

#include "src/matching/matcher.h"
#include "src/objective/block_kernels.h"

namespace icpscape {

/// Some matched pairs with all that metrics need of them, value by value side by side: small enough
/// to stay in the first-level cache while one metric after the other goes over them.
class PairBlock {
 public:
  static constexpr std::size_t kCapacity = kBlockPairs;

  std::size_t size() const { return values_.size; }
  const BlockValues& values() const { return values_; }

  /// Forgets all pairs.
  void Clear() { values_.size = 0; }

  /// Adds the source point at place k of the matcher's order with the match that is entry m of the
  /// matches; nothing where there is none. Fits are looked up only if `needs` asks for them.
  void Add(const Matcher& matcher, const Matches& matches, std::size_t m, std::size_t k,
           unsigned needs);

  /// One pair as the metrics over double take it.
  Correspondence Pair(std::size_t i) const;

  /// Fetches into the cache what Add will look up for entry m: where a match is in the memory is
  /// not for the processor to guess.
  static void Prefetch(const Matcher& matcher, const Matches& matches, std::size_t m) {
    if (matches.target_index[m] >= 0) {
      __builtin_prefetch(&Target(matcher, matches, m));
    }
  }

 private:
  static const PackedPoint& Target(const Matcher& matcher, const Matches& matches, std::size_t m) {
    const SearchableCloud& target = matcher.searchable_target();
    const auto j = static_cast<std::size_t>(matches.target_index[m]);
    return target.packed()[static_cast<std::size_t>(target.Place(j))];
  }

  BlockValues values_ = {};
};

// In the header, because it is much of what a pass does besides the search.
inline void PairBlock::Add(const Matcher& matcher, const Matches& matches, std::size_t m,
                           std::size_t k, unsigned needs) {
  if (matches.target_index[m] < 0) {
    return;
  }
  const PackedPoint& source = matcher.searchable_source().packed()[k];
  const PackedPoint& target = Target(matcher, matches, m);
  const std::size_t i = values_.size++;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    values_.p_source[axis][i] = source.point[axis];
    values_.q_target[axis][i] = target.point[axis];
    values_.n_source[axis][i] = source.normal[axis];
    values_.n_target[axis][i] = target.normal[axis];
  }
  values_.provided[i] = kTargetLine | kTargetPatch | (source.NormalIsValid() ? kSourceNormal : 0U) |
                        (target.NormalIsValid() ? kTargetNormal : 0U);
  if ((needs & (kTargetLine | kTargetPatch)) != 0) {
    const LocalFit& fit = matches.fits[m];
    for (int axis = 0; axis < 3; ++axis) {
      values_.anchor[axis][i] = fit.anchor[axis];
      values_.direction[axis][i] = fit.direction[axis];
    }
    values_.area_patch = matcher.area_patch();
  }
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
