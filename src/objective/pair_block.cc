// SPDX-License-Identifier: BSD-3-Clause
#include "src/objective/pair_block.h"

namespace icpscape {

void PairBlock::Add(const Matcher& matcher, const Matches& matches, std::size_t m, std::size_t i,
                    unsigned needs) {
  if (matches.target_index[m] < 0) {
    return;
  }
  const auto j = static_cast<std::size_t>(matches.target_index[m]);
  Correspondence& c = pairs[size];
  unsigned has = kTargetLine | kTargetPatch;
  c.p_source = matcher.source().Point(i);
  c.q_target = matcher.target().Point(j);
  if ((needs & kSourceNormal) != 0 && matcher.source().NormalIsValid(i)) {
    c.n_source = matcher.source().Normal(i);
    has |= kSourceNormal;
  }
  if ((needs & kTargetNormal) != 0 && matcher.target().NormalIsValid(j)) {
    c.n_target = matcher.target().Normal(j);
    has |= kTargetNormal;
  }
  if ((needs & kTargetLine) != 0) {
    c.a_line = matches.fits[m].anchor;
    c.d_line = matches.fits[m].direction;
  }
  if ((needs & kTargetPatch) != 0) {
    c.q_patch = matches.fits[m].anchor;
    c.n_patch = matches.fits[m].direction;
    c.area_patch = matcher.area_patch();
  }
  provided[size++] = has;
}

}  // namespace icpscape
