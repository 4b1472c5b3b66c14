// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/pair_block.h"

namespace icpscape {

std::optional<Correspondence> PairBlock::Pair(std::size_t i, unsigned needs) const {
  const auto at = [i](const auto& values) {
    return Vec3(values[0][i], values[1][i], values[2][i]);
  };
  Correspondence c;
  c.p_source = at(values_.p_source);
  c.q_target = at(values_.q_target);
  c.n_source = at(values_.n_source);
  c.n_target = at(values_.n_target);
  c.a_line = c.q_patch = at(values_.anchor);
  c.d_line = c.n_patch = at(values_.direction);
  c.area_patch = values_.area_patch;
  const bool lacks_normal = ((needs & kSourceNormal) != 0 && c.n_source.isZero(0)) ||
                            ((needs & kTargetNormal) != 0 && c.n_target.isZero(0));
  return values_.matched[i] != 0 && !lacks_normal ? std::optional(c) : std::nullopt;
}

}  // namespace icpscape
