// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/residuals/correspondence.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "icpscape/residuals/registry.h"
#include "icpscape/testing/residual_sampler.h"

namespace icpscape {
namespace {

TEST(Quantities, ListEveryMemberAndNeed) {
  std::size_t bytes = 0;
  unsigned needs = 0;
  ForEachQuantity<double>([&](auto row) {
    using Row = decltype(row);
    bytes += sizeof(typename Row::Kind::template Value<double>);
    needs |= Row::kNeed;
  });
  EXPECT_EQ(bytes, sizeof(Correspondence)) << "a member has no row";
  std::set<std::string> names;
  unsigned named = 0;
  for (const NamedNeed& need : kNamedNeeds) {
    EXPECT_TRUE(names.insert(need.name).second) << need.name;
    named |= need.need;
  }
  EXPECT_EQ(needs, named);
  ForEachMetric([&](auto tag) { EXPECT_EQ(decltype(tag)::Metric::kNeeds & ~named, 0U); });
}

TEST(Quantities, ComeFromWhereTheirNeedsSay) {
  const auto from = [](Origin origin) {
    return NeedsFrom(origin) & (kSourceNormal | kTargetNormal | kTargetLine | kTargetPatch);
  };
  EXPECT_EQ(from(Origin::kSourceCloud), kSourceNormal);
  EXPECT_EQ(from(Origin::kTargetCloud), kTargetNormal);
  EXPECT_EQ(from(Origin::kFit), kTargetLine | kTargetPatch);
  EXPECT_EQ(from(Origin::kMatching), kTargetPatch);
  EXPECT_EQ(NeedsText(kPointsOnly), "");
  EXPECT_EQ(NeedsText(kTargetPatch | kSourceNormal), "source normals, patch through neighbours");
}

TEST(Quantities, ChangeFramesEachInItsOwn) {
  ResidualSampler sampler(2);
  const Correspondence c = sampler.Pair(sampler.Pose(3, 1), 0.5);
  const SE3d S = sampler.Pose(5, 2);
  const SE3d T = sampler.Pose(5, 2);
  const Correspondence moved = ChangeFrames(c, S, T);
  EXPECT_EQ(moved.p_source, S * c.p_source);
  EXPECT_EQ(moved.n_source, S.R() * c.n_source);
  EXPECT_EQ(moved.q_target, T * c.q_target);
  EXPECT_EQ(moved.n_target, T.R() * c.n_target);
  EXPECT_EQ(moved.a_line, T * c.a_line);
  EXPECT_EQ(moved.d_line, T.R() * c.d_line);
  EXPECT_EQ(moved.q_patch, T * c.q_patch);
  EXPECT_EQ(moved.n_patch, T.R() * c.n_patch);
  EXPECT_EQ(moved.area_patch, c.area_patch);
  EXPECT_EQ(moved.R_matched, T.R() * c.R_matched * S.R().transpose());
}

TEST(Quantities, AreMappedWhereTheyAreNeeded) {
  ResidualSampler sampler(3);
  const Correspondence c = sampler.Pair(SE3d(), 0.5);
  int mapped = 0;
  const CorrespondenceOf<float> half =
      MapQuantities<float>(c, kTargetNormal, [&](auto row, const auto& value) {
        using Kind = typename decltype(row)::Kind;
        ++mapped;
        return Kind::template Make<float>([&](std::size_t k) {
          return static_cast<float>(0.5 * Kind::template NumberOf<double>(value, k));
        });
      });
  EXPECT_EQ(mapped, 4);  // p, q, R and n_q.
  EXPECT_EQ(half.p_source, (0.5 * c.p_source).cast<float>());
  EXPECT_EQ(half.R_matched, (0.5 * c.R_matched).cast<float>());
  EXPECT_EQ(half.q_target, (0.5 * c.q_target).cast<float>());
  EXPECT_EQ(half.n_target, (0.5 * c.n_target).cast<float>());
}

}  // namespace
}  // namespace icpscape
