// SPDX-License-Identifier: BSD-3-Clause
// What an objective makes of pairs that are few enough to be computed by hand.
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "icpscape/objective/loss.h"
#include "icpscape/objective/objective.h"
#include "icpscape/objective/pairs.h"
#include "icpscape/residuals/registry.h"
#include "tests/support/matchers.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using ::testing::HasSubstr;
using testing_support::AddPoint;
using testing_support::FixedMatcher;
using testing_support::MessageOf;

void AddNormal(const Vec3& n, PointCloud* cloud) {
  cloud->nx.push_back(static_cast<float>(n.x()));
  cloud->ny.push_back(static_cast<float>(n.y()));
  cloud->nz.push_back(static_cast<float>(n.z()));
}

// One pair at a pose that turns by 90 degrees about z: T p = (4, 5, 7), and e = T p - q is
// (0, 1, 2) from the point and (3, 4, 2) from the line's and the patch's anchor.
struct OnePair {
  PointCloud source, target;
  SE3d T;
  OnePair() {
    AddPoint({5, -4, 6}, &source);
    AddNormal({1, 0, 0}, &source);  // Turned: (0, 1, 0).
    AddPoint({4, 4, 5}, &target);
    AddNormal({0, 0, 1}, &target);
    Mat3 R;
    R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    T = SE3d(R, Vec3(0, 0, 1));
  }
  FixedMatcher Matcher() const { return {source, target, {Vec3(1, 1, 5), Vec3::UnitZ()}, 0.5}; }
};

struct Sums {
  double squared, epsilon, cost;
};

TEST(OnePair, IsWhatEveryMetricSaysByHand) {
  const auto distance = [](double r) { return Sums{r * r, r * r, r * r / 2}; };
  const double split = 2 + std::sqrt(0.5);    // (1, 0, 1) turned by 45 degrees.
  const double patch = std::sqrt(117.0) - 1;  // sqrt(1 + |e / A|^2) - 1 with |e|^2 = 29, A = 1/2.
  const std::map<std::string, Sums> expected = {
      {"point_to_point", distance(std::sqrt(5.0))},
      {"point_to_plane", distance(2)},
      {"symmetric", distance(2)},          // e . (1, 0, 1): the source's normal does not turn.
      {"symmetric_rotated", distance(3)},  // e . (0, 1, 1)
      {"symmetric_split", distance(split)},
      {"two_plane", distance(std::sqrt(4.0 + 1.0))},
      {"edge_to_line", {25, 5, 12.5}},  // The paper sums the distance itself.
      {"edge_to_line_distance", {25, 5, 12.5}},
      {"planar_to_patch", {116, patch, patch}},
      {"planar_to_plane", distance(2)},
  };
  const OnePair pair;
  const FixedMatcher matcher = pair.Matcher();
  std::size_t metrics = 0;
  ForEachMetric([&](auto tag) {
    const std::string metric = decltype(tag)::Metric::kName;
    ASSERT_EQ(expected.count(metric), 1U) << metric << " has no value by hand here";
    ++metrics;
    const Objective objective(metric, matcher);
    const Matches matches = objective.Match(pair.T, 1);
    const Evaluation sums = objective.Evaluate(pair.T, matches, 1);
    EXPECT_EQ(sums.n(), 1) << metric;
    EXPECT_NEAR(sums.sum_squared, expected.at(metric).squared, 1e-12) << metric;
    EXPECT_NEAR(sums.epsilon, expected.at(metric).epsilon, 1e-12) << metric;
    EXPECT_NEAR(sums.sums.cost, expected.at(metric).cost, 1e-12) << metric;
    EXPECT_FALSE(sums.sums.upward_loss) << metric;
    for (int i = 0; i < 6; ++i) {
      constexpr double h = 1e-6;
      const auto at = [&](double step) {
        return objective.Evaluate(pair.T * SE3d::Exp(step * Vec6::Unit(i)), matches, 1);
      };
      const Evaluation ahead = at(h), back = at(-h);
      const double size = 1 + expected.at(metric).squared;
      EXPECT_NEAR(sums.epsilon_gradient[i], (ahead.epsilon - back.epsilon) / (2 * h), 1e-7 * size)
          << metric;
      EXPECT_NEAR(sums.sums.gradient[i], (ahead.sums.cost - back.sums.cost) / (2 * h), 1e-7 * size)
          << metric;
    }
  });
  EXPECT_EQ(metrics, expected.size());
}

// The patch's own loss is SoftLOneLoss(1), but a loss that is asked for takes its place. At
// |r| = sqrt(116) the Huber loss of 2 costs (2 * 2 * |r| - 4) / 2.
TEST(OnePair, ThePatchsLossGivesWayToAnother) {
  const OnePair pair;
  const FixedMatcher matcher = pair.Matcher();
  const Objective huber("planar_to_patch", matcher, MakeLoss("huber", 2));
  const Evaluation sums = huber.Evaluate(pair.T, 1);
  EXPECT_NEAR(sums.sums.cost, 2 * std::sqrt(116.0) - 2, 1e-12);
  EXPECT_NEAR(sums.epsilon, std::sqrt(117.0) - 1, 1e-12);
  EXPECT_NEAR(sums.sum_squared, 116, 1e-12);
  EXPECT_EQ(Objective("edge_to_line", matcher).loss(), nullptr);
}

// 17 pairs with every combination of normals along x, y and z and none at either end, the last one
// without a match. What has no normal adds nothing to any sum, also not under a loss.
struct Gaps {
  PointCloud source, target;
  Gaps() {
    const Vec3 normals[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3::Zero()};
    for (int i = 0; i < 17; ++i) {
      AddPoint({10.0 * i, 1, 2}, &source);
      AddNormal(normals[i / 4 % 4], &source);
      AddPoint({10.0 * i + 0.1, 1.2 + 0.01 * i, 1.7}, &target);
      AddNormal(normals[i % 4], &target);
    }
  }
  // The residuals of pair i; none where it has no part.
  std::vector<double> Residuals(const std::string& metric, std::size_t i) const {
    const Vec3 e = source.Point(i) - target.Point(i);
    const Vec3 n_s = source.Normal(i), n_t = target.Normal(i);
    if (i == 16 || (metric != "point_to_point" && n_t.isZero()) ||
        (metric != "point_to_point" && metric != "point_to_plane" && n_s.isZero())) {
      return {};
    }
    return metric == "point_to_point"   ? std::vector<double>{e.x(), e.y(), e.z()}
           : metric == "point_to_plane" ? std::vector<double>{e.dot(n_t)}
           : metric == "symmetric"      ? std::vector<double>{e.dot(n_s + n_t)}
                                        : std::vector<double>{e.dot(n_t), e.dot(n_s)};
  }
};

// (The weights of the lanes in the sums of rho and eps change nothing: both are 0 at s = 0.)
TEST(MissingNormals, AddNothingToAnySum) {
  const Gaps gaps;
  const FixedMatcher matcher(gaps.source, gaps.target, {Vec3::Zero(), Vec3::UnitZ()}, 0, {16});
  const std::map<std::string, long> pairs = {
      {"point_to_point", 16}, {"point_to_plane", 12}, {"symmetric", 9}, {"two_plane", 9}};
  for (const auto& [metric, n] : pairs) {
    for (const char* loss_name : {"none", "huber", "tolerant"}) {
      const auto loss = MakeLoss(loss_name, 0.25);
      const Objective objective(metric, matcher, loss);
      double squared = 0, cost = 0;
      for (std::size_t i = 0; i < 17; ++i) {
        const std::vector<double> r = gaps.Residuals(metric, i);
        double s = 0;
        for (const double value : r) {
          s += value * value;
        }
        double rho[3] = {s, 1, 0};
        if (loss != nullptr && !r.empty()) {
          loss->Evaluate(s, rho);
        }
        squared += s;
        cost += rho[0] / 2;
      }
      const Evaluation sums = objective.Evaluate(SE3d(), 1);
      EXPECT_EQ(sums.n(), n) << metric << " " << loss_name;
      EXPECT_NEAR(sums.sums.cost, cost, 1e-12) << metric << " " << loss_name;
      EXPECT_NEAR(sums.sum_squared, squared, 1e-12) << metric << " " << loss_name;
      EXPECT_NEAR(sums.epsilon, squared, 1e-12) << metric << " " << loss_name;

      ceres::Problem::Options borrowed;
      borrowed.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
      ceres::Problem problem(borrowed);
      double x[7], ceres_cost = 0;
      SE3d().ToParameters(x);
      objective.AddResidualBlocks(objective.Match(SE3d(), 1), loss.get(), x, &problem);
      EXPECT_EQ(problem.NumResidualBlocks(), n) << metric;
      ASSERT_TRUE(problem.Evaluate({}, &ceres_cost, nullptr, nullptr, nullptr));
      EXPECT_NEAR(ceres_cost, cost, 1e-12) << metric << " " << loss_name;
    }
  }
}

// The tolerant loss curves upwards at its step alone: one pair of 5000 stands there, and the others
// so far beyond that rho'' is 0.
struct OneAtTheStep {
  PointCloud source, target;
  explicit OneAtTheStep(int place) {
    for (int i = 0; i < 5000; ++i) {
      AddPoint({0.5 * i, 0, 0}, &source);
      AddNormal(i == place ? Vec3(0, 0, 0) : Vec3(0, 0, 1), &source);
      AddPoint({0.5 * i, 0, i == place ? 0.01 : 0.1}, &target);
      AddNormal(Vec3::UnitZ(), &target);
    }
  }
};

TEST(UpwardLoss, IsReportedWhereverThePairStands) {
  for (const int place : {0, 1, 1700, 2100, 3333, 4999}) {
    const OneAtTheStep scene(place);
    const auto tolerant = MakeLoss("tolerant", 0.01);
    const FixedMatcher all(scene.source, scene.target);
    const FixedMatcher others(scene.source, scene.target, {Vec3::Zero(), Vec3::UnitZ()}, 0,
                              {place});
    const auto upward = [&](const char* metric, const Matcher& matcher) {
      const Evaluation sums = Objective(metric, matcher, tolerant).Evaluate(SE3d(), 1);
      EXPECT_EQ(Objective(metric, matcher, tolerant).Evaluate(SE3d(), 3).sums.upward_loss,
                sums.sums.upward_loss);
      return sums.sums.upward_loss;
    };
    EXPECT_TRUE(upward("point_to_plane", all)) << place;
    EXPECT_FALSE(upward("point_to_plane", others)) << place;  // Without a match,
    EXPECT_FALSE(upward("symmetric", all)) << place;          // or without a normal.
  }
}

TEST(ForEachPair, NamesThePointsOfEveryPairOnce) {
  const testing_support::MovedRoom room(1500, SE3d::Exp(Vec6::Constant(0.02)));
  const ClosestPointMatcher matcher(room.source, room.target);
  const Objective objective("two_plane", matcher);
  const SE3d T = SE3d::Exp(Vec6::Constant(0.03));
  const Matches matches = objective.Match(T, 1);
  std::set<std::size_t> seen;
  ForEachPair(objective, matches, [&](std::size_t i, std::size_t j, const Correspondence& pair) {
    EXPECT_TRUE(seen.insert(i).second) << i;
    EXPECT_EQ(static_cast<std::int32_t>(j), matches.target_index[i]);
    EXPECT_EQ(pair.p_source, room.source.Point(i));
    EXPECT_EQ(pair.n_source, room.source.Normal(i));
    EXPECT_EQ(pair.q_target, room.target.Point(j));
    EXPECT_EQ(pair.n_target, room.target.Normal(j));
  });
  EXPECT_EQ(static_cast<long>(seen.size()), objective.Evaluate(T, matches, 1).n());
  EXPECT_GT(seen.size(), 1000U);
}

TEST(Objective, RefusesAMatcherThatLacksItsNeeds) {
  PointCloud with = OnePair().source, without = with;
  without.nx.clear(), without.ny.clear(), without.nz.clear();
  const ClosestPointMatcher both(with, with), no_source(without, with), no_target(with, without);
  const auto message = [](const char* metric, const Matcher& matcher) {
    return MessageOf<UsageError>([&] { Objective(metric, matcher); });
  };
  EXPECT_THAT(message("edge_to_line", both), HasSubstr("needs more than its matcher provides"));
  EXPECT_THAT(message("symmetric", no_source),
              HasSubstr("needs source normals; the source cloud has none"));
  EXPECT_THAT(message("point_to_plane", no_target),
              HasSubstr("needs target normals; the target cloud has none"));
}

TEST(Objective, RefusesMatchesOfAnotherSource) {
  const ClosestPointMatcher matcher(OnePair().source, OnePair().source);
  const Objective objective("point_to_point", matcher);
  const Matches of_another_cloud{{0, 0}};
  EXPECT_THAT(MessageOf<UsageError>([&] { objective.Evaluate(SE3d(), of_another_cloud, 1); }),
              HasSubstr("Matches of 2 points; expected one for each of the source's 1."));
}

}  // namespace
}  // namespace icpscape
