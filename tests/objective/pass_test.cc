// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/pass.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "icpscape/landscape/curve.h"
#include "icpscape/objective/loss.h"
#include "icpscape/objective/objective_set.h"
#include "icpscape/residuals/registry.h"
#include "tests/support/matchers.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes.h"
#include "tests/support/simd_levels.h"

namespace icpscape {
namespace {

const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.3, 0.05, -0.02).finished());

// Turned and moved, and not where the minimum is.
const SE3d kPose = SE3d::Exp((Vec6() << -0.01, 0.02, 0.03, 0.2, 0.1, 0.02).finished());

const testing_support::MovedRoom& Room() {
  static const testing_support::MovedRoom room(6001, kMotion);
  return room;
}

void ExpectSameBits(const Evaluation& a, const Evaluation& b) {
  EXPECT_EQ(a.sums.cost, b.sums.cost);
  EXPECT_EQ(a.sums.gradient, b.sums.gradient);
  EXPECT_EQ(a.sums.hessian, b.sums.hessian);
  EXPECT_EQ(a.n(), b.n());
  EXPECT_EQ(a.sum_squared, b.sum_squared);
  EXPECT_EQ(a.epsilon, b.epsilon);
  EXPECT_EQ(a.epsilon_gradient, b.epsilon_gradient);
}

// Objectives of all metrics: two matchers of local fits, one of closest points.
struct AllObjectives {
  std::vector<std::unique_ptr<Matcher>> matchers;
  std::vector<Objective> objectives;
  std::vector<const Objective*> pointers;

  explicit AllObjectives(const std::shared_ptr<const ceres::LossFunction>& loss = nullptr) {
    objectives.reserve(100);
    ForEachMetric([&](auto tag) {
      using Metric = typename decltype(tag)::Metric;
      Matcher* shared = nullptr;
      for (const auto& matcher : matchers) {
        if (MatcherKindFor(Metric::kNeeds).provides == matcher->Provides()) {
          shared = matcher.get();
        }
      }
      if (shared == nullptr) {
        matchers.push_back(
            testing_support::MatcherFor(Metric::kName, Room().source, Room().target));
        shared = matchers.back().get();
      }
      objectives.emplace_back(Metric::kName, *shared, loss);
    });
    for (const Objective& objective : objectives) {
      pointers.push_back(&objective);
    }
  }
};

// The sums, pair by pair from the residuals themselves, by the header that other solvers use.
TEST(Pass, SumsWhatTheResidualsSay) {
  for (const char* loss_name : {"none", "huber", "cauchy"}) {
    const AllObjectives all(MakeLoss(loss_name, 0.05));
    const std::vector<Evaluation> evaluations =
        EvaluateAll(all.pointers, kPose, Derivatives::kHessian, 1);
    std::size_t m = 0;
    ForEachMetric([&](auto tag) {
      using Metric = typename decltype(tag)::Metric;
      const Objective& objective = all.objectives[m];
      const Matches matches = objective.Match(kPose, 1);
      NormalEquations sums;
      double epsilon = 0;
      for (std::size_t i = 0; i < matches.target_index.size(); ++i) {
        if (matches.target_index[i] < 0) {
          continue;
        }
        const Metric metric =
            Metric::From(testing_support::PairByHand(objective.matcher(), matches, i));
        const auto r = metric.Residual(kPose);
        double rho[3] = {r.squaredNorm(), 1, 0};
        if (objective.loss() != nullptr) {
          objective.loss()->Evaluate(r.squaredNorm(), rho);
        }
        sums.Add(r, metric.Jacobian(kPose), rho);
        epsilon += EvaluateEpsilon(Metric::kEpsilon, r.squaredNorm()).value;
      }
      const Evaluation& ours = evaluations[m++];
      EXPECT_EQ(ours.n(), sums.num_correspondences) << Metric::kName;
      EXPECT_GT(ours.n(), 100) << Metric::kName;
      EXPECT_NEAR(ours.sums.cost, sums.cost, 1e-12 * sums.cost) << Metric::kName;
      EXPECT_NEAR(ours.epsilon, epsilon, 1e-12 * epsilon) << Metric::kName;
      EXPECT_LE((ours.sums.Hessian() - sums.Hessian()).norm(), 1e-12 * sums.Hessian().norm());
      EXPECT_LE((ours.sums.gradient - sums.gradient).norm(),
                1e-12 * std::sqrt(sums.Hessian().trace() * sums.cost));
    });
  }
}

TEST(Pass, TogetherIsAsEachAlone) {
  const AllObjectives all;
  const std::vector<Evaluation> together =
      EvaluateAll(all.pointers, kPose, Derivatives::kHessian, 2);
  for (std::size_t m = 0; m < all.objectives.size(); ++m) {
    ExpectSameBits(together[m], all.objectives[m].Evaluate(kPose, 1));
  }
}

// Points are there for one metric though another one of the same matcher wants lines.
TEST(Pass, TogetherIsAsEachAloneWhereOneNeedsLines) {
  const auto lines = testing_support::MatcherFor("edge_to_line", Room().source, Room().target);
  const Objective points("point_to_point", *lines);
  const Objective edges("edge_to_line", *lines);
  const auto together = EvaluateAll({&points, &edges}, kPose, Derivatives::kHessian, 1);
  ExpectSameBits(together[0], points.Evaluate(kPose, 1));
  ExpectSameBits(together[1], edges.Evaluate(kPose, 1));
  const auto reversed = EvaluateAll({&edges, &points}, kPose, Derivatives::kHessian, 1);
  ExpectSameBits(reversed[0], edges.Evaluate(kPose, 1));
  ExpectSameBits(reversed[1], points.Evaluate(kPose, 1));
}

TEST(Pass, LeavesOutPairsWithoutANormalOnEitherSide) {
  PointCloud source = Room().source;
  PointCloud target = Room().target;
  source.nx[3] = source.ny[3] = source.nz[3] = 0;
  source.ny[5] = std::numeric_limits<float>::quiet_NaN();
  const ClosestPointMatcher matcher(source, target);
  const Matches matches = Objective("point_to_point", matcher).Match(kPose, 1);
  const auto j = static_cast<std::size_t>(matches.target_index[7]);
  target.nx[j] = target.ny[j] = target.nz[j] = 0;
  const long into_j =
      std::count(matches.target_index.begin(), matches.target_index.end(), matches.target_index[7]);
  const ClosestPointMatcher with_gaps(source, target);
  const auto n = [&](const char* metric) {
    const Evaluation evaluation = Objective(metric, with_gaps).Evaluate(kPose, 1);
    EXPECT_TRUE(std::isfinite(evaluation.sums.cost)) << metric;
    return evaluation.n();
  };
  EXPECT_EQ(n("point_to_point"), 6001);
  EXPECT_EQ(n("point_to_plane"), 6001 - into_j);
  EXPECT_EQ(n("symmetric"), 6001 - into_j - 2);
}

TEST(Pass, FewerDerivativesChangeNothingElse) {
  const AllObjectives all;
  const auto hessian = EvaluateAll(all.pointers, kPose, Derivatives::kHessian, 1);
  const auto gradient = EvaluateAll(all.pointers, kPose, Derivatives::kGradient, 1);
  const auto none = EvaluateAll(all.pointers, kPose, Derivatives::kNone, 1);
  for (std::size_t m = 0; m < all.objectives.size(); ++m) {
    Evaluation expected = hessian[m];
    expected.sums.hessian.setZero();
    ExpectSameBits(gradient[m], expected);
    expected.sums.gradient.setZero();
    expected.epsilon_gradient.setZero();
    ExpectSameBits(none[m], expected);
  }
}

TEST(Pass, KeptMatchesAreThoseOfThePose) {
  MatchingOptions half;
  half.kept_fraction = 0.5;
  const ClosestPointMatcher trimmed(Room().source, Room().target, half);
  const Objective rejecting("point_to_plane", trimmed);
  AllObjectives all;
  all.pointers.push_back(&rejecting);
  MatchesByMatcher kept;
  const auto associated = EvaluateAll(all.pointers, kPose, Derivatives::kHessian, 2, &kept);
  const auto frozen = EvaluateAll(all.pointers, kPose, kept, Derivatives::kHessian, 1);
  const MatchesByMatcher matched = MatchAll(all.pointers, kPose, 2);
  EXPECT_EQ(kept.size(), 4U);
  for (const auto& [matcher, matches] : kept) {
    EXPECT_EQ(matches.target_index, matched.at(matcher).target_index);
    // With the pose, whether rejections made the matcher see all pairs first or not.
    EXPECT_EQ(matches.T_target_source.Matrix(), kPose.Matrix());
    EXPECT_EQ(matched.at(matcher).T_target_source.Matrix(), kPose.Matrix());
    Matches part;
    matcher->MatchPart(kMotion, 0, 10, &part);
    EXPECT_EQ(part.T_target_source.Matrix(), kMotion.Matrix());
  }
  for (std::size_t m = 0; m < all.pointers.size(); ++m) {
    ExpectSameBits(associated[m], frozen[m]);
  }
  EXPECT_EQ(associated.back().n(), 3001);  // Of 6001, rounded.
}

TEST(Pass, RefusesFrozenMatchesThatLackAMatcher) {
  const AllObjectives all;
  EXPECT_EQ(testing_support::MessageOf<UsageError>([&] {
              EvaluateAll(all.pointers, kPose, MatchesByMatcher(), Derivatives::kHessian, 1);
            }),
            "A matcher has no matches; expected those of each.");
}

TEST(Pass, IsTheSameBitsForAnyThreadsAndEverySimdLevel) {
  std::vector<std::vector<Evaluation>> results;
  std::vector<std::vector<float>> normals;
  for (const SimdLevel level : SupportedSimdLevels()) {
    const testing_support::ScopedSimdLevel scoped(level);
    PointCloud cloud = Room().source;
    for (const int threads : {1, 2, 4}) {
      const AllObjectives all(MakeLoss("huber", 0.05));
      results.push_back(EvaluateAll(all.pointers, kPose, Derivatives::kHessian, threads));
      EstimateNormals({}, threads, &cloud);
      normals.push_back(cloud.nx);
    }
  }
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(normals[i], normals[0]);
    for (std::size_t m = 0; m < results[i].size(); ++m) {
      ExpectSameBits(results[i][m], results[0][m]);
    }
  }
}

}  // namespace
}  // namespace icpscape
