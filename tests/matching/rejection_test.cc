// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/matching/rejection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "icpscape/common/error.h"
#include "icpscape/io/sequences.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

using testing::ElementsAre;

PointCloud Cloud(const std::vector<Vec3>& points) {
  PointCloud cloud;
  for (const Vec3& p : points) {
    cloud.x.push_back(static_cast<float>(p.x()));
    cloud.y.push_back(static_cast<float>(p.y()));
    cloud.z.push_back(static_cast<float>(p.z()));
  }
  return cloud;
}

PointCloud Row(const std::vector<double>& x) {
  std::vector<Vec3> points;
  for (const double value : x) {
    points.emplace_back(value, 0, 0);
  }
  return Cloud(points);
}

PointCloud Random(unsigned seed, int size) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-5, 5);
  std::vector<Vec3> points;
  for (int i = 0; i < size; ++i) {
    points.emplace_back(uniform(random), uniform(random), uniform(random));
  }
  return Cloud(points);
}

SE3d SomeMotion() {
  Vec6 xi;
  xi << 0.1, -0.2, 0.3, 0.4, 0.5, -0.6;
  return SE3d::Exp(xi);
}

TEST(ReciprocalRejector, KeepsPairsThatLeadBack) {
  // 0 and 0.9 both go to the target's 1; back from 1 the way leads to 0.9. 5 -> 5.2 -> 5.
  const PointCloud source = Row({0, 0.9, 5}), target = Row({1, 5.2});
  const SearchableCloud searchable(source);
  Matches matches{{0, 0, 1}};
  RejectNotReciprocal(searchable, target, SE3d(), 0, 1, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(-1, 0, 1));
  matches.target_index = {0, 0, -1};
  RejectNotReciprocal(searchable, target, SE3d(), 0.899, 1, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(-1, 0, -1));
  matches.target_index = {0, 0, 1};
  RejectNotReciprocal(searchable, target, SE3d(), 0.91, 1, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(0, 0, 1));
  for (const double epsilon : {-1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(RejectNotReciprocal(searchable, target, SE3d(), epsilon, 1, &matches), UsageError);
  }
}

TEST(ReciprocalRejector, TakesCopiesOfAPointForOne) {
  const PointCloud source = Row({1, 1, 3}), target = Row({1.1});
  Matches matches{{0, 0, 0}};
  RejectNotReciprocal(source, target, SE3d(), 0, 1, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(0, 0, -1));
}

// Farther than a float can say from everything: nothing leads back.
TEST(ReciprocalRejector, RejectsWhatIsTooFarToBeNearAnything) {
  const PointCloud source = Row({1, 2}), target = Row({1, 1e30});
  Matches matches{{0, 1}};
  RejectNotReciprocal(source, target, SE3d(), 1e6, 1, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(0, -1));
}

TEST(ReciprocalRejector, WorksAtThePose) {
  // At the true pose a moved copy is reciprocal throughout; matches are its own points.
  const PointCloud source = Random(1, 500);
  const PointCloud target = source.Transformed(SomeMotion());
  Matches matches;
  ClosestPointMatcher(source, target).Match(SomeMotion(), 1, &matches);
  RejectNotReciprocal(source, target, SomeMotion(), 0, 1, &matches);
  for (std::size_t i = 0; i < source.size(); ++i) {
    EXPECT_EQ(matches.target_index[i], static_cast<std::int32_t>(i));
  }
}

TEST(ReciprocalRejector, EqualsBruteForceForAnyNumberOfThreads) {
  const PointCloud source = Random(2, 5000), target = Random(3, 4000);
  const SE3d T = SomeMotion();
  Matches all;
  ClosestPointMatcher(source, target).Match(T, 1, &all);
  const SearchableCloud searchable(source);
  for (const double epsilon : {0., 0.3}) {
    Matches one = all, three = all;
    RejectNotReciprocal(searchable, target, T, epsilon, 1, &one);
    RejectNotReciprocal(searchable, target, T, epsilon, 3, &three);
    EXPECT_EQ(one.target_index, three.target_index);
    EXPECT_LT(one.Count(), all.Count());
    for (std::size_t i = 0; i < source.size(); i += 10) {
      // Distances in the target frame this time, in double.
      const Vec3 q = target.Point(static_cast<std::size_t>(all.target_index[i]));
      std::size_t nearest = 0;
      for (std::size_t k = 1; k < source.size(); ++k) {
        if ((T * source.Point(k) - q).norm() < (T * source.Point(nearest) - q).norm()) {
          nearest = k;
        }
      }
      const bool keep = (source.Point(i) - source.Point(nearest)).norm() <= epsilon;
      EXPECT_EQ(one.target_index[i] >= 0, keep) << i;
    }
  }
}

// Pairs 0.1, 0.2, 0.3, 0.4 and 5 m apart, and a point without a match.
struct Distances : testing::Test {
  PointCloud source = Row({0, 10, 20, 30, 40, 50});
  PointCloud target = Row({0.1, 10.2, 20.3, 30.4, 45});
  Matches matches{{0, 1, 2, 3, 4, -1}};
};

TEST_F(Distances, AreGated) {
  RejectDistant(source, target, SE3d(), 0.35, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(0, 1, 2, -1, -1, -1));
  EXPECT_THROW(RejectDistant(source, target, SE3d(), 0, &matches), UsageError);
  matches = {{-1, -1, -1, -1, 4, -1}};
  RejectDistant(source, target, SE3d(), 5, &matches);  // Exactly as far is not farther.
  EXPECT_EQ(matches.Count(), 1U);
}

TEST_F(Distances, AreGatedAtThePose) {
  RejectDistant(source, target, SE3d(Mat3::Identity(), Vec3(5, 0, 0)), 0.35, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(-1, -1, -1, -1, 4, -1));
}

TEST_F(Distances, AreComparedWithTheMedian) {
  RejectBeyondMedian(source, target, SE3d(), 1.5, &matches);  // The median is 0.3 m.
  EXPECT_THAT(matches.target_index, ElementsAre(0, 1, 2, 3, -1, -1));
  RejectBeyondMedian(source, target, SE3d(), 1.1, &matches);  // Now the lower one: 0.2 m.
  EXPECT_THAT(matches.target_index, ElementsAre(0, 1, -1, -1, -1, -1));
  EXPECT_THROW(RejectBeyondMedian(source, target, SE3d(), 0, &matches), UsageError);
}

TEST_F(Distances, AreTrimmed) {
  Matches half = matches, none = matches;
  RejectTrimmed(source, target, SE3d(), 0.5, &half);  // 2.5 of five rounds to three.
  EXPECT_THAT(half.target_index, ElementsAre(0, 1, 2, -1, -1, -1));
  RejectTrimmed(source, target, SE3d(), 0, &none);
  EXPECT_EQ(none.Count(), 0U);
  RejectTrimmed(source, target, SE3d(), 1, &matches);
  EXPECT_EQ(matches.Count(), 5U);
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(RejectTrimmed(source, target, SE3d(), share, &matches), UsageError);
  }
}

TEST(RejectTrimmed, GoesByIndexAmongEqualDistances) {
  const PointCloud source = Row({0, 4, 8, 12}), target = Row({1, 5, 9, 13});
  Matches matches{{0, 1, 2, 3}};
  RejectTrimmed(source, target, SE3d(), 0.5, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(0, 1, -1, -1));
}

TEST(RejectByNormalAngle, TurnsTheSourcesNormals) {
  PointCloud source = Row({1, 2, 3, 4}), target = source;
  source.nx = {1, 1, 1, 0};
  source.ny = {0, 0, 0, 0};
  source.nz = {0, 0, 0, 0};
  // A turn of 90 degrees about z makes the source's normals (0, 1, 0).
  target.nx = {0, 0.6F, 0, 0};
  target.ny = {1, 0.8F, -1, 1};
  target.nz = {0, 0, 0, 0};
  Mat3 R;
  R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const SE3d T(R, Vec3::Zero());
  const double angle = std::acos(0.8);
  const Matches all{{0, 1, 2, 3}};
  Matches matches = all;
  RejectByNormalAngle(source, target, T, angle + 1e-6, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(0, 1, -1, -1));
  matches = all;
  RejectByNormalAngle(source, target, T, angle - 1e-6, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(0, -1, -1, -1));
  matches = all;
  RejectByNormalAngle(source, target, T, M_PI, &matches);  // A missing normal is still rejected.
  EXPECT_THAT(matches.target_index, ElementsAre(0, 1, 2, -1));
  for (const double beyond : {-0.1, 3.2, std::nan("")}) {
    EXPECT_THROW(RejectByNormalAngle(source, target, T, beyond, &matches), UsageError);
  }
  EXPECT_THROW(RejectByNormalAngle(source, Row({1, 2, 3, 4}), T, 1, &matches), InputError);
  EXPECT_THROW(RejectByNormalAngle(Row({1, 2, 3, 4}), target, T, 1, &matches), InputError);
  // A normal that is missing in the target alone.
  target.nx[0] = target.ny[0] = target.nz[0] = 0;
  matches = all;
  RejectByNormalAngle(source, target, T, M_PI, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(-1, 1, 2, -1));
}

TEST(RejectRegions, DropsTheWholeRegionThatMatchesBadly) {
  // Three cubes of 10 m with mean distances 0.1, 0.15 and 1.05 m; the last one's good pair goes
  // too.
  const PointCloud source = Row({1, 2, 11, 12, -1, -2, -3});
  const PointCloud target = Row({1.1, 2.1, 11.1, 12.2, 1, -2.1});
  Matches matches{{0, 1, 2, 3, 4, 5, -1}};
  RejectRegions(source, target, SE3d(), {10, 2}, &matches);
  EXPECT_THAT(matches.target_index, ElementsAre(0, 1, 2, 3, -1, -1, -1));
  // By default cubes of 10 m and twice the median: 0.31 m is dropped beside 0.1, 0.15 and 0.15 m,
  // but not where it shares the first cube with the 0.1 m.
  for (const auto& [x, kept] : {std::pair(11.0, false), std::pair(9.5, true)}) {
    const PointCloud pairs = Row({1, x, 21, 31}), off = Row({1.1, x + 0.31, 21.15, 31.15});
    Matches three{{0, 1, 2, 3}};
    RejectRegions(pairs, off, SE3d(), {}, &three);
    EXPECT_EQ(three.target_index[1], kept ? 1 : -1) << x;
  }
  RegionOptions options;
  for (const double size : {0.0, -10.0, HUGE_VAL, std::nan("")}) {
    options.region_size_m = size;
    EXPECT_THROW(RejectRegions(source, target, SE3d(), options, &matches), UsageError);
  }
  options = {};
  options.median_factor = 0;
  EXPECT_THROW(RejectRegions(source, target, SE3d(), options, &matches), UsageError);
}

// Good pairs at 1 m and a bad one on the other side of a cube's wall, along each axis in turn.
TEST(RejectRegions, AreCubesFromTheOriginAlongEveryAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double bad : {-1.0, 7.0}) {
      std::vector<Vec3> p = {{1, 1, 1}, {2, 1, 1}, {1, 101, 1}, {101, 1, 1}}, q = p;
      p.emplace_back(1, 1, 1);
      p.back()[axis] = bad;
      q.push_back(p.back() + Vec3(0, 0, 0.5));
      for (std::size_t i = 0; i < 4; ++i) {
        q[i].z() += 0.1;
      }
      Matches matches{{0, 1, 2, 3, 4}};
      RejectRegions(Cloud(p), Cloud(q), SE3d(), {6, 3}, &matches);
      EXPECT_THAT(matches.target_index, ElementsAre(0, 1, 2, 3, -1)) << axis << " " << bad;
      matches = {{0, 1, 2, 3, 4}};
      // Five times the median, or in a cube with two good pairs: a mean of 0.23 m.
      const RegionOptions lenient = bad < 0 ? RegionOptions{6, 5.5} : RegionOptions{8, 3};
      RejectRegions(Cloud(p), Cloud(q), SE3d(), lenient, &matches);
      EXPECT_EQ(matches.Count(), 5U) << axis << " " << bad;
    }
  }
}

TEST(Rejection, LeavesNoMatchesAsTheyAre) {
  const PointCloud source = Row({1, 2}), target = Row({1});
  const Matches none{{-1, -1}};
  Matches matches = none;
  RejectBeyondMedian(source, target, SE3d(), 1, &matches);
  RejectTrimmed(source, target, SE3d(), 0.5, &matches);
  RejectRegions(source, target, SE3d(), {}, &matches);
  RejectDistant(source, target, SE3d(), 1, &matches);
  RejectNotReciprocal(source, target, SE3d(), 0, 1, &matches);
  EXPECT_EQ(matches.target_index, none.target_index);
}

TEST(ReciprocalRejector, KeepsOneSourcePointPerTargetPointOnARealPair) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const PointCloud source = KittiScan("00", 15), target = KittiScan("00", 14);
  const SE3d T = *OpenKittiSequence(KittiRoot(), "00").Motion(14, 15);
  Matches all;
  ClosestPointMatcher(source, target).Match(T, 2, &all);
  Matches strict = all, relaxed = all;
  const SearchableCloud searchable(source);
  RejectNotReciprocal(searchable, target, T, 0, 2, &strict);
  RejectNotReciprocal(searchable, target, T, 0.2, 2, &relaxed);
  std::vector<char> used(target.size(), 0);
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (strict.target_index[i] >= 0) {
      char& mark = used[static_cast<std::size_t>(strict.target_index[i])];
      EXPECT_EQ(mark, 0);
      mark = 1;
      EXPECT_EQ(relaxed.target_index[i], strict.target_index[i]);
    }
  }
  EXPECT_LT(strict.Count(), relaxed.Count());
  EXPECT_LT(relaxed.Count(), all.Count());
}

}  // namespace
}  // namespace icpscape
