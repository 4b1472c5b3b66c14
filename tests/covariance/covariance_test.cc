// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/covariance.h"

#include <ceres/covariance.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <random>

#include "icpscape/cloud/normals.h"
#include "icpscape/covariance/consistency.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/objective/loss.h"
#include "icpscape/residuals/adapters/ceres.h"
#include "icpscape/residuals/point_to_plane.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

// The minimum over frozen pairs, by Gauss-Newton until nothing moves.
SE3d FrozenMinimum(const Objective& objective, const Matches& matches, SE3d T) {
  for (int i = 0; i < 50; ++i) {
    const NormalEquations sums = objective.Evaluate(T, matches, 1).sums;
    const Vec6 step = -sums.Hessian().ldlt().solve(sums.gradient);
    T = T * SE3d::Exp(step);
    if (step.norm() < 1e-13) {
      break;
    }
  }
  return T;
}

CovarianceOptions Cubes(double cluster_m) {
  CovarianceOptions options;
  options.cluster_m = cluster_m;
  return options;
}

void SetPoint(const Vec3& p, std::size_t i, PointCloud* cloud) {
  cloud->x[i] = static_cast<float>(p.x());
  cloud->y[i] = static_cast<float>(p.y());
  cloud->z[i] = static_cast<float>(p.z());
}

// A small room: fewer target points than source points, so that many pairs share their target.
class SmallRoom : public testing::Test {
 protected:
  SmallRoom() {
    target_ = testing_support::Room(60, 1, SE3d(), 0.05);
    source_ = testing_support::Room(150, 2, kMotion.Inverse(), 0.05);
    std::mt19937 engine(5);
    for (PointCloud* cloud : {&source_, &target_}) {
      for (std::size_t i = 0; i < cloud->size(); ++i) {
        cloud->ring.push_back(static_cast<std::int32_t>(engine() % 4));
      }
      // Normals are given: as the estimators have it, they are constants.
      EstimateNormals({8, 0}, 1, cloud);
    }
  }

  // The covariance that independent noise on single ranges (or on all ranges of a ring) would give,
  // by moving points, minimising again over the same pairs, and differencing.
  template <class GroupOf>
  Mat6 ByPerturbation(const std::string& metric, int groups, const GroupOf& group_of) const {
    constexpr double h = 2e-3;  // Large, because stored points are floats.
    const ClosestPointMatcher matcher(source_, target_);
    const Objective objective(metric, matcher);
    const Matches matches = objective.Match(kMotion, 1);
    const SE3d T = FrozenMinimum(objective, matches, kMotion);
    Mat6 covariance = Mat6::Zero();
    for (int group = 0; group < groups; ++group) {
      Vec6 difference = Vec6::Zero();
      for (const double sign : {1.0, -1.0}) {
        PointCloud source = source_;
        PointCloud target = target_;
        for (PointCloud* cloud : {&source, &target}) {
          for (std::size_t i = 0; i < cloud->size(); ++i) {
            if (group_of(cloud == &source, i) == group) {
              SetPoint(cloud->Point(i) + sign * h * cloud->Point(i).normalized(), i, cloud);
            }
          }
        }
        const ClosestPointMatcher moved_matcher(source, target);
        const Objective moved(metric, moved_matcher);
        difference += sign * (T.Inverse() * FrozenMinimum(moved, matches, T)).Log() / (2 * h);
      }
      covariance += difference * difference.transpose();
    }
    return covariance;
  }

  CovarianceSums SumsAtMinimum(const std::string& metric) const {
    const ClosestPointMatcher matcher(source_, target_);
    const Objective objective(metric, matcher);
    const Matches matches = objective.Match(kMotion, 1);
    return SumForCovariance(objective, FrozenMinimum(objective, matches, kMotion), matches, {});
  }

  const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.3, 0.05, -0.02).finished());
  PointCloud source_;
  PointCloud target_;
};

TEST_F(SmallRoom, GaussNewtonIsCeresCovariance) {
  const ClosestPointMatcher matcher(source_, target_);
  for (const char* metric : {"point_to_plane", "two_plane"}) {
    const Objective objective(metric, matcher);
    const Matches matches = objective.Match(kMotion, 1);
    const SE3d T = FrozenMinimum(objective, matches, kMotion);
    const CovarianceSums sums = SumForCovariance(objective, T, matches, {});
    double x[7];
    T.ToParameters(x);
    ceres::Problem problem;
    problem.AddParameterBlock(x, 7, new SE3Manifold);
    objective.AddResidualBlocks(matches, nullptr, x, &problem);
    ASSERT_EQ(sums.rows, problem.NumResiduals());
    ceres::Covariance ceres_covariance{ceres::Covariance::Options()};
    const std::vector<const double*> block = {x};
    ASSERT_TRUE(ceres_covariance.Compute(block, &problem));
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> unscaled;
    ASSERT_TRUE(ceres_covariance.GetCovarianceBlockInTangentSpace(x, x, unscaled.data()));
    double cost = 0;
    problem.Evaluate({}, &cost, nullptr, nullptr, nullptr);
    const Mat6 expected = 2 * cost / (problem.NumResiduals() - 6) * unscaled;
    const std::optional<Mat6> actual =
        EstimateCovariance(Estimator::kGaussNewton, sums, CovarianceOptions());
    ASSERT_TRUE(actual);
    EXPECT_LE((*actual - expected).norm(), 1e-9 * expected.norm()) << metric;
  }
}

TEST_F(SmallRoom, CensiIsWhatMovingEveryRangeDoes) {
  CovarianceOptions options;
  options.range_noise_m = 0.03;
  options.ring_bias_m = 0.01;
  const int sources = static_cast<int>(source_.size());
  const int points = sources + static_cast<int>(target_.size());
  for (const char* metric : {"point_to_plane", "symmetric", "point_to_point"}) {
    const CovarianceSums sums = SumsAtMinimum(metric);
    const Mat6 ranges = ByPerturbation(metric, points, [&](bool is_source, std::size_t i) {
      return static_cast<int>(i) + (is_source ? 0 : sources);
    });
    const std::optional<Mat6> censi = EstimateCovariance(Estimator::kCensi, sums, options);
    ASSERT_TRUE(censi);
    EXPECT_LE((*censi - 0.03 * 0.03 * ranges).norm(), 2e-3 * censi->norm()) << metric;
    const Mat6 rings = ByPerturbation(metric, 4, [&](bool is_source, std::size_t i) {
      return (is_source ? source_ : target_).ring[i];
    });
    const std::optional<Mat6> both = EstimateCovariance(Estimator::kCensiRingBias, sums, options);
    ASSERT_TRUE(both);
    const Mat6 expected = 0.03 * 0.03 * ranges + 0.01 * 0.01 * rings;
    EXPECT_LE((*both - expected).norm(), 2e-3 * expected.norm()) << metric;
  }
}

// One cube around everything: at a minimum the gradients add up to zero. Cubes that hold a point
// each: sums over the pairs of a target point, here by hand.
TEST_F(SmallRoom, ClustersRunFromOnePointToEverything) {
  // Eight cubes meet at the sensor: shift the room into one of them.
  const SE3d into_one(Mat3::Identity(), Vec3(100, 100, 100));
  const PointCloud target = target_.Transformed(into_one);
  const ClosestPointMatcher matcher(source_, target);
  const Objective objective("point_to_plane", matcher);
  const Matches matches = objective.Match(into_one * kMotion, 1);
  const SE3d T = FrozenMinimum(objective, matches, into_one * kMotion);
  const CovarianceSums all = SumForCovariance(objective, T, matches, Cubes(1000));
  EXPECT_EQ(all.clusters, 1);
  EXPECT_EQ(all.pairs, static_cast<long>(source_.size()));
  EXPECT_LE(all.cluster_scores.norm(), 1e-12 * all.scores.norm());
  EXPECT_FALSE(EstimateCovariance(Estimator::kSandwichClustered, all, CovarianceOptions()));
  std::vector<Vec6> sums(target.size(), Vec6::Zero());
  for (std::size_t i = 0; i < source_.size(); ++i) {
    const auto j = static_cast<std::size_t>(matches.target_index[i]);
    const PointToPlane pair{source_.Point(i), target.Point(j), target.Normal(j)};
    sums[j] += pair.Jacobian(T).transpose() * pair.Residual(T);
  }
  Mat6 expected = Mat6::Zero();
  for (const Vec6& sum : sums) {
    expected += sum * sum.transpose();
  }
  const CovarianceSums by_point = SumForCovariance(objective, T, matches, Cubes(0.01));
  EXPECT_LE((by_point.cluster_scores - expected).norm(), 1e-9 * expected.norm());
}

// Where their assumptions hold, they must be right: pairs, normals and world are given, ranges are
// noisy. Gauss-Newton is left out: noise along rays is not equal on all planes.
TEST_F(SmallRoom, EstimatorsAreConsistentWhereTheirAssumptionsHold) {
  std::mt19937 engine(9);
  std::normal_distribution<double> noise(0, 0.02);
  // A world without noise: every source point on the plane of its target point.
  const ClosestPointMatcher matcher(source_, target_);
  const Objective objective("point_to_plane", matcher);
  const Matches matches = objective.Match(kMotion, 1);
  for (std::size_t i = 0; i < source_.size(); ++i) {
    const auto j = static_cast<std::size_t>(matches.target_index[i]);
    const Vec3 n = target_.Normal(j);
    const Vec3 q = kMotion * source_.Point(i);
    SetPoint(kMotion.Inverse() * (q - n.dot(q - target_.Point(j)) * n), i, &source_);
  }
  CovarianceOptions options;
  options.range_noise_m = 0.02;
  std::vector<Vec6> errors;
  std::vector<Mat6> censi;
  std::vector<Mat6> clustered;
  for (int draw = 0; draw < 300; ++draw) {
    PointCloud source = source_;
    PointCloud target = target_;
    for (PointCloud* cloud : {&source, &target}) {
      for (std::size_t i = 0; i < cloud->size(); ++i) {
        SetPoint(cloud->Point(i) + noise(engine) * cloud->Point(i).normalized(), i, cloud);
      }
    }
    const ClosestPointMatcher noisy_matcher(source, target);
    const Objective noisy("point_to_plane", noisy_matcher);
    const SE3d T = FrozenMinimum(noisy, matches, kMotion);
    errors.push_back((kMotion.Inverse() * T).Log());
    const CovarianceSums sums = SumForCovariance(noisy, T, matches, Cubes(0.01));
    censi.push_back(*EstimateCovariance(Estimator::kCensi, sums, options));
    clustered.push_back(*EstimateCovariance(Estimator::kSandwichClustered, sums, options));
  }
  const Nees nees = NeesAboutTruth(errors, censi);
  EXPECT_TRUE(nees.Consistent()) << nees.mean << " not in " << nees.lower << " to " << nees.upper;
  // 60 clusters for six unknowns: known to be over-confident by sqrt(1 / (1 - 6 / 60)) and more.
  EXPECT_LT(NeesAboutTruth(errors, clustered).Overconfidence(), 1.3);
  EXPECT_GT(NeesAboutTruth(errors, clustered).Overconfidence(), 0.9);
}

// A loss bends A but not the sums of squares of the gradients; all stay positive definite.
TEST_F(SmallRoom, WorksUnderALossAndWithEveryEstimator) {
  const ClosestPointMatcher matcher(source_, target_);
  const Objective objective("symmetric", matcher, MakeLoss("huber", 0.1));
  const Matches matches = objective.Match(kMotion, 1);
  const CovarianceSums sums =
      SumForCovariance(objective, FrozenMinimum(objective, matches, kMotion), {}, 1);
  for (const Estimator estimator : AllOf<Estimator>()) {
    const std::optional<Mat6> covariance = EstimateCovariance(estimator, sums, CovarianceOptions());
    ASSERT_TRUE(covariance) << NameOf(estimator);
    EXPECT_GT(covariance->llt().matrixL().determinant(), 0) << NameOf(estimator);
  }
}

// Target points so far apart that no pair changes: following the pose is keeping the pairs.
TEST(Covariance, RematchedIsClusteredWherePairsStay) {
  PointCloud target;
  PointCloud source;
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> uniform(-0.05, 0.05);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < 2; ++k) {
        const Vec3 p(3 * i - 7, 3 * j - 8, 3 * k - 1);
        testing_support::AddPoint(p, &target);
        testing_support::AddPoint(p + Vec3(uniform(engine), uniform(engine), uniform(engine)),
                                  &source);
      }
    }
  }
  const ClosestPointMatcher matcher(source, target);
  const Objective objective("point_to_point", matcher);
  const SE3d T = FrozenMinimum(objective, objective.Match(SE3d(), 1), SE3d());
  const CovarianceSums sums = SumForCovariance(objective, T, {}, 2);
  EXPECT_LE((sums.rematched_hessian - sums.hessian).norm(), 1e-4 * sums.hessian.norm());
  const auto clustered = EstimateCovariance(Estimator::kSandwichClustered, sums, {});
  const auto rematched = EstimateCovariance(Estimator::kSandwichRematched, sums, {});
  ASSERT_TRUE(clustered && rematched);
  EXPECT_LE((*clustered - *rematched).norm(), 1e-3 * clustered->norm());
}

// Keeps the poses at which it is asked.
class RecordingMatcher final : public Matcher {
 public:
  explicit RecordingMatcher(const Matcher& inner)
      : Matcher(inner.searchable_source(), inner.searchable_target()), inner_(inner) {}
  unsigned Provides() const override { return inner_.Provides(); }
  const std::vector<SE3d>& asked() const { return asked_; }

 private:
  void FindPart(const SE3d& T, std::size_t begin, std::size_t end,
                Matches* matches) const override {
    asked_.push_back(T);
    inner_.MatchPart(T, begin, end, matches);
  }

  const Matcher& inner_;
  mutable std::vector<SE3d> asked_;
};

// The rematched Hessian is differenced over two poses for each direction: translations by the step,
// and rotations that move points at 10 m by as much.
TEST_F(SmallRoom, RematchesAtStepsThatMovePointsAtTenMetresAlike) {
  const ClosestPointMatcher inner(source_, target_);
  const RecordingMatcher matcher(inner);
  CovarianceOptions options;
  options.rematching_step_m = 0.03;
  const Objective objective("point_to_plane", matcher);
  SumForCovariance(objective, kMotion, options, 1);
  for (int axis = 0; axis < 6; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vec6 step = sign * (axis < 3 ? 0.003 : 0.03) * Vec6::Unit(axis);
      EXPECT_TRUE(std::any_of(matcher.asked().begin(), matcher.asked().end(), [&](const SE3d& T) {
        return ((kMotion.Inverse() * T).Log() - step).norm() < 1e-9;
      })) << step.transpose();
    }
  }
}

// A wall slides along itself for free, once pairs follow the pose; frozen point-to-point pairs hold
// it with one row per point [Bonnabel et al. 2016].
TEST(Covariance, OnlyRematchingSeesThatAWallSlides) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> uniform(-5, 5);
  PointCloud clouds[2];
  for (PointCloud& cloud : clouds) {
    for (int i = 0; i < 20000; ++i) {
      testing_support::AddPoint(Vec3(uniform(engine), 4, uniform(engine)), &cloud);
    }
  }
  const ClosestPointMatcher matcher(clouds[0], clouds[1]);
  const Objective objective("point_to_point", matcher);
  CovarianceOptions options;
  options.rematching_step_m = 0.1;  // Beyond the points' spacing of 7 cm.
  const CovarianceSums sums = SumForCovariance(objective, SE3d(), options, 2);
  EXPECT_NEAR(sums.hessian(3, 3), 20000, 1);
  EXPECT_NEAR(sums.hessian(4, 4), 20000, 1);
  EXPECT_LT(sums.rematched_hessian(3, 3), 0.2 * 20000);
  EXPECT_NEAR(sums.rematched_hessian(4, 4), 20000, 0.05 * 20000);
}

}  // namespace
}  // namespace icpscape
