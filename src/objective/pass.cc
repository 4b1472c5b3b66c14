// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/pass.h"

#include <algorithm>
#include <string>

#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"

namespace icpscape {
namespace {

// The objectives of one matcher and their places in the list.
struct Group {
  const Matcher* matcher;
  std::vector<std::size_t> members;
};

std::vector<Group> GroupByMatcher(const std::vector<const Objective*>& objectives) {
  std::vector<Group> groups;
  for (std::size_t m = 0; m < objectives.size(); ++m) {
    const Matcher* matcher = &objectives[m]->matcher();
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.matcher == matcher; });
    if (group == groups.end()) {
      group = groups.insert(group, {matcher, {}});
    }
    group->members.push_back(m);
  }
  return groups;
}

class GroupPass {
 public:
  GroupPass(const Group& group, const std::vector<const Objective*>& objectives, const SE3d& T,
            Derivatives derivatives)
      : matcher_(*group.matcher), T_(T), derivatives_(derivatives) {
    for (const std::size_t m : group.members) {
      objectives_.push_back(objectives[m]);
      needs_ |= objectives[m]->needs();
    }
  }

  /// Sums over [begin, end) of the matcher's order: `matches` has an entry per source point, or,
  /// where `in_order`, one for each of these.
  void Sum(std::size_t begin, std::size_t end, const Matches& matches, bool in_order,
           Evaluation* sums) const {
    const auto entry = [&](std::size_t k) {
      return in_order ? k - begin : static_cast<std::size_t>(matcher_.Order()[k]);
    };
    PairBlock block;
    for (std::size_t k = begin; k < end; k += PairBlock::kCapacity) {
      block.Fill(matcher_, matches, k, std::min(end, k + PairBlock::kCapacity), needs_, entry);
      for (std::size_t m = 0; m < objectives_.size(); ++m) {
        objectives_[m]->Add(block, T_, derivatives_, &sums[m]);
      }
    }
  }

  /// The sums of all parts; part(begin, end, sums) sums one.
  template <class Part>
  std::vector<Evaluation> SumParts(int threads, const Part& part) const {
    const std::size_t size = objectives_.size();
    const std::size_t points = matcher_.Order().size();
    std::vector<Evaluation> parts((points + kPartSize - 1) / kPartSize * size);
    ForEachPart(points, threads, [&](std::size_t begin, std::size_t end) {
      part(begin, end, &parts[begin / kPartSize * size]);
    });
    std::vector<Evaluation> sums(size);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      sums[i % size].Add(parts[i], 1);
    }
    return sums;
  }

  std::vector<Evaluation> Frozen(const Matches& matches, int threads) const {
    if (matches.target_index.size() != matcher_.source().size()) {
      throw UsageError("Matches of " + std::to_string(matches.target_index.size()) +
                       " points; expected one for each of the source's " +
                       std::to_string(matcher_.source().size()) + ".");
    }
    return SumParts(threads, [&](std::size_t begin, std::size_t end, Evaluation* sums) {
      Sum(begin, end, matches, false, sums);
    });
  }

  std::vector<Evaluation> Reassociated(int threads, Matches* keep) const {
    Matches own;
    if (matcher_.Rejects()) {
      Matches* const matches = keep != nullptr ? keep : &own;
      matcher_.Match(T_, threads, matches);
      return Frozen(*matches, threads);
    }
    if (keep != nullptr) {
      matcher_.Clear(T_, keep);
    }
    return SumParts(threads, [&](std::size_t begin, std::size_t end, Evaluation* sums) {
      thread_local Matches part;
      matcher_.MatchPart(T_, begin, end, &part);
      if (keep != nullptr) {
        matcher_.Keep(part, begin, end, keep);
      }
      Sum(begin, end, part, true, sums);
    });
  }

 private:
  const Matcher& matcher_;
  const SE3d& T_;
  Derivatives derivatives_;
  std::vector<const Objective*> objectives_;
  unsigned needs_ = 0;
};

// evaluate(pass, matcher) for every group; the results in the order of the objectives.
template <class Evaluate>
std::vector<Evaluation> ForEachGroup(const std::vector<const Objective*>& objectives, const SE3d& T,
                                     Derivatives derivatives, const Evaluate& evaluate) {
  std::vector<Evaluation> results(objectives.size());
  for (const Group& group : GroupByMatcher(objectives)) {
    const std::vector<Evaluation> sums =
        evaluate(GroupPass(group, objectives, T, derivatives), group.matcher);
    for (std::size_t m = 0; m < sums.size(); ++m) {
      results[group.members[m]] = sums[m];
    }
  }
  return results;
}

}  // namespace

MatchesByMatcher MatchAll(const std::vector<const Objective*>& objectives,
                          const SE3d& T_target_source, int threads) {
  MatchesByMatcher matches;
  for (const Group& group : GroupByMatcher(objectives)) {
    group.matcher->Match(T_target_source, threads, &matches[group.matcher]);
  }
  return matches;
}

std::vector<Evaluation> EvaluateAll(const std::vector<const Objective*>& objectives,
                                    const SE3d& T_target_source, Derivatives derivatives,
                                    int threads, MatchesByMatcher* keep) {
  return ForEachGroup(
      objectives, T_target_source, derivatives, [&](const GroupPass& pass, const Matcher* matcher) {
        return pass.Reassociated(threads, keep != nullptr ? &(*keep)[matcher] : nullptr);
      });
}

std::vector<Evaluation> EvaluateAll(const std::vector<const Objective*>& objectives,
                                    const SE3d& T_target_source, const MatchesByMatcher& frozen,
                                    Derivatives derivatives, int threads) {
  return ForEachGroup(objectives, T_target_source, derivatives,
                      [&](const GroupPass& pass, const Matcher* matcher) {
                        const auto matches = frozen.find(matcher);
                        if (matches == frozen.end()) {
                          throw UsageError("A matcher has no matches; expected those of each.");
                        }
                        return pass.Frozen(matches->second, threads);
                      });
}

}  // namespace icpscape
