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

  /// Adds the source point at place k of the matcher's order with the match that is entry m of the
  /// matches; nothing where there is none. Fits are looked up only if `needs` asks for them.
  void Add(const Matcher& matcher, const Matches& matches, std::size_t m, std::size_t k,
           unsigned needs);

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
};

// In the header, because it is half of a pass that the search does not take.
inline void PairBlock::Add(const Matcher& matcher, const Matches& matches, std::size_t m,
                           std::size_t k, unsigned needs) {
  if (matches.target_index[m] < 0) {
    return;
  }
  const PackedPoint& source = matcher.searchable_source().packed()[k];
  const PackedPoint& target = Target(matcher, matches, m);
  Correspondence& c = pairs[size];
  c.p_source = source.Point();
  c.q_target = target.Point();
  c.n_source = source.Normal();
  c.n_target = target.Normal();
  provided[size] = kTargetLine | kTargetPatch | (source.NormalIsValid() ? kSourceNormal : 0U) |
                   (target.NormalIsValid() ? kTargetNormal : 0U);
  if ((needs & (kTargetLine | kTargetPatch)) != 0) {
    const LocalFit& fit = matches.fits[m];
    c.a_line = c.q_patch = fit.anchor;
    c.d_line = c.n_patch = fit.direction;
    c.area_patch = matcher.area_patch();
  }
  ++size;
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
