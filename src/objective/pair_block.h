// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
#define ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_

#include <algorithm>
#include <optional>

#include "residuals/correspondence.h"
#include "src/matching/matcher.h"
#include "src/objective/block_kernels.h"

namespace icpscape {

/// A run of source points in the matcher's order, with their matches and all that metrics need of
/// them: small enough to stay in the first-level cache while one metric after the other goes over
/// them.
class PairBlock {
 public:
  static constexpr std::size_t kCapacity = kBlockPairs;

  const BlockValues& values() const { return values_; }

  /// Takes the source points [begin, end) of the matcher's order, at most kCapacity. The match of
  /// point k is entry entry_of(k) of the matches. Fits are left out unless `needs`, a union
  /// of Needs, has one.
  template <class EntryOf>
  void Fill(const Matcher& matcher, const Matches& matches, std::size_t begin, std::size_t end,
            unsigned needs, const EntryOf& entry_of);

  /// The pair of the i-th of these points as metrics over double take it; nothing where there is
  /// no match, or no normal that is needed.
  std::optional<Correspondence> Pair(std::size_t i, unsigned needs) const;

 private:
  BlockValues values_ = {};
};

// In the header, because it is much of what a pass does besides the search.
template <class EntryOf>
void PairBlock::Fill(const Matcher& matcher, const Matches& matches, std::size_t begin,
                     std::size_t end, unsigned needs, const EntryOf& entry_of) {
  const PointsView source = matcher.searchable_source().points().Slice(begin, end);
  const PointsView source_normals = matcher.searchable_source().normals().Slice(begin, end);
  const SearchableCloud& target_cloud = matcher.searchable_target();
  const PointsView target = target_cloud.points();
  const PointsView normals = target_cloud.normals();
  const float* const p_source[3] = {source.x, source.y, source.z};
  const float* const n_source[3] = {source_normals.x, source_normals.y, source_normals.z};
  std::copy(p_source, p_source + 3, values_.p_source);
  std::copy(n_source, n_source + 3, values_.n_source);
  values_.area_patch = matcher.area_patch();
  values_.size = end - begin;
  const bool fits = (needs & (kTargetLine | kTargetPatch)) != 0;
  for (std::size_t i = 0; i < end - begin; ++i) {
    const std::size_t m = entry_of(begin + i);
    const std::int32_t j = matches.target_index[m];
    const std::int32_t found = j < 0 ? -1 : target_cloud.Place(static_cast<std::size_t>(j));
    values_.matched[i] = found < 0 ? 0.0F : 1.0F;
    if (found < 0) {
      continue;
    }
    const auto place = static_cast<std::size_t>(found);
    if (fits) {
      for (int axis = 0; axis < 3; ++axis) {
        values_.anchor[axis][i] = matches.fits[m].anchor[axis];
        values_.direction[axis][i] = matches.fits[m].direction[axis];
      }
    }
    values_.q_target[0][i] = target.x[place];
    values_.q_target[1][i] = target.y[place];
    values_.q_target[2][i] = target.z[place];
    values_.n_target[0][i] = normals.x[place];
    values_.n_target[1][i] = normals.y[place];
    values_.n_target[2][i] = normals.z[place];
  }
  // Behind the last pair nothing counts.
  std::fill(values_.matched + values_.size, values_.matched + kCapacity, 0.0F);
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_OBJECTIVE_PAIR_BLOCK_H_
