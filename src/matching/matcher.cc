// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/matcher.h"

#include <algorithm>

#include "icpscape/common/parallel.h"

namespace icpscape {

std::size_t Matches::Count() const {
  return static_cast<std::size_t>(
      std::count_if(target_index.begin(), target_index.end(), [](int j) { return j >= 0; }));
}

void Matcher::MatchPart(const SE3d& T_target_source, std::size_t begin, std::size_t end,
                        Matches* matches) const {
  matches->T_target_source = T_target_source;
  FindPart(T_target_source, begin, end, matches);
}

void Matcher::Clear(const SE3d& T_target_source, Matches* matches) const {
  matches->T_target_source = T_target_source;
  const bool fits = (Provides() & NeedsFrom(Origin::kFit)) != 0;
  matches->target_index.assign(source().size(), -1);
  matches->fits.resize(fits ? source().size() : 0);
}

void Matcher::Keep(const Matches& part, std::size_t begin, std::size_t end,
                   Matches* matches) const {
  for (std::size_t k = begin; k < end; ++k) {
    const auto i = static_cast<std::size_t>(Order()[k]);
    matches->target_index[i] = part.target_index[k - begin];
    if (!matches->fits.empty()) {
      matches->fits[i] = part.fits[k - begin];
    }
  }
}

void Matcher::Match(const SE3d& T_target_source, int threads, Matches* matches) const {
  Clear(T_target_source, matches);
  ForEachPart(Order().size(), threads, [&](std::size_t begin, std::size_t end) {
    thread_local Matches part;
    MatchPart(T_target_source, begin, end, &part);
    Keep(part, begin, end, matches);
  });
  Reject(T_target_source, threads, matches);
}

}  // namespace icpscape
