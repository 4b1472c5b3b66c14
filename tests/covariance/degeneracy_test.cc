// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/degeneracy.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "icpscape/cloud/displacement.h"
#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/minimizer/minimizer.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulated_sequence.h"
#include "tests/support/matchers.h"
#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using Constraints = std::vector<PlaneConstraint>;

// A square lattice of 21 x 21 points on a plane through `center`, with side vectors a and b.
void AddPlane(const Vec3& center, const Vec3& a, const Vec3& b, Constraints* constraints) {
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) {
      constraints->push_back({center + 0.1 * i * a + 0.1 * j * b, a.cross(b).normalized()});
    }
  }
}

Constraints Plane() {
  Constraints ground;
  AddPlane({0, 0, -2}, {5, 0, 0}, {0, 5, 0}, &ground);
  return ground;
}
// Along x, without ends.
Constraints Corridor() {
  Constraints corridor = Plane();
  AddPlane({0, 3, 0}, {5, 0, 0}, {0, 0, 2}, &corridor);
  AddPlane({0, -3, 0}, {5, 0, 0}, {0, 0, 2}, &corridor);
  return corridor;
}
Constraints Room() {
  Constraints room = Corridor();
  AddPlane({5, 0, 0}, {0, 3, 0}, {0, 0, 2}, &room);
  AddPlane({-5, 0, 0}, {0, 3, 0}, {0, 0, 2}, &room);
  return room;
}
// A round tunnel along x.
Constraints Cylinder() {
  Constraints tunnel;
  for (int i = -20; i <= 20; ++i) {
    for (int k = 0; k < 48; ++k) {
      const Vec3 n(0, std::cos(2 * M_PI * k / 48), std::sin(2 * M_PI * k / 48));
      tunnel.push_back({0.5 * i * Vec3::UnitX() + 3 * n, n});
    }
  }
  return tunnel;
}

Mat6 HessianOf(const Constraints& constraints) {
  Mat6 hessian = Mat6::Zero();
  for (const PlaneConstraint& c : constraints) {
    Vec6 row;
    row << c.p_source.cross(c.n_source), c.n_source;
    hessian += row * row.transpose();
  }
  return hessian;
}

// How much of the space of what a rule calls degenerate is in this direction: 1 is all of it.
double DegenerateShare(const std::vector<Judgement>& judgements, const std::string& rule,
                       const Vec6& direction) {
  double share = 0;
  for (const Judgement& judgement : judgements) {
    if (judgement.rule == rule && judgement.localizability == Localizability::kNone) {
      share += std::pow(judgement.direction.dot(direction.normalized()), 2);
    }
  }
  return share;
}

// Every rule must call these axes degenerate, and no others.
void ExpectDegenerate(const Constraints& scene, const std::vector<int>& axes) {
  const std::vector<Judgement> judgements = JudgeDegeneracy(HessianOf(scene), scene);
  ASSERT_EQ(judgements.size(), 24U);
  for (const char* rule : {"loam_odometry", "loam_mapping", "x_icp", "dcreg"}) {
    for (int axis = 0; axis < 6; ++axis) {
      const bool expected = std::find(axes.begin(), axes.end(), axis) != axes.end();
      EXPECT_NEAR(DegenerateShare(judgements, rule, Vec6::Unit(axis)), expected ? 1 : 0, 1e-6)
          << rule << ", axis " << axis;
    }
  }
}

constexpr int kRoll = 0, kYaw = 2, kX = 3, kY = 4;

TEST(Degeneracy, ARoomHasNone) { ExpectDegenerate(Room(), {}); }
TEST(Degeneracy, ACorridorSlidesAlong) { ExpectDegenerate(Corridor(), {kX}); }
TEST(Degeneracy, APlaneSlidesBothWaysAndTurns) { ExpectDegenerate(Plane(), {kX, kY, kYaw}); }
TEST(Degeneracy, ATunnelSlidesAlongAndRolls) { ExpectDegenerate(Cylinder(), {kX, kRoll}); }

// X-ICP's judgement on x for `points` pairs whose normals have this x component, the rest of it to
// the left and to the right in turns.
Judgement XicpAlongX(double x_component, int points) {
  Constraints walls;
  for (int i = 0; i < points; ++i) {
    const double rest = (i % 2 == 0 ? 1 : -1) * std::sqrt(1 - x_component * x_component);
    walls.push_back({Vec3(5, 0.1 * i, 0.2 * (i % 7)), Vec3(x_component, rest, 0)});
  }
  for (const Judgement& judgement : JudgeXicp(HessianOf(walls), walls)) {
    if (std::abs(judgement.direction[kX]) > 0.9) {
      return judgement;
    }
  }
  ADD_FAILURE() << "no direction along x";
  return Judgement{};
}

// Normals along x contribute 1 each to L_c and L_s, and the thresholds of L_s decide: 35 and 180.
TEST(Degeneracy, XicpCountsStrongContributions) {
  const auto category = [](int points) {
    const Judgement judgement = XicpAlongX(1, points);
    EXPECT_NEAR(judgement.value, points, 1e-9);
    EXPECT_EQ(judgement.threshold, 180);
    return judgement.localizability;
  };
  EXPECT_EQ(category(34), Localizability::kNone);
  EXPECT_EQ(category(35), Localizability::kPartial);
  EXPECT_EQ(category(179), Localizability::kPartial);
  EXPECT_EQ(category(180), Localizability::kFull);
}

// Normals 60 degrees from x contribute 1/2 each to L_c and nothing to L_s: its thresholds are 180
// and 250.
TEST(Degeneracy, XicpCountsWeakContributions) {
  const auto category = [](int points) {
    const Judgement judgement = XicpAlongX(0.5, points);
    EXPECT_NEAR(judgement.value, 0.5 * points, 1e-9);
    return judgement.localizability;
  };
  EXPECT_EQ(category(358), Localizability::kNone);
  EXPECT_EQ(category(360), Localizability::kPartial);
  EXPECT_EQ(category(498), Localizability::kPartial);
  EXPECT_EQ(category(500), Localizability::kFull);
}

// Below cos(80 deg) a contribution is noise, and from cos(45 deg) on it is strong. (No normal meets
// a cosine exactly: whether these bounds belong to either side makes no difference.)
TEST(Degeneracy, XicpTellsNoiseAndStrengthByTheAngle) {
  const auto cosine = [](double degrees) { return std::cos(degrees * M_PI / 180); };
  EXPECT_EQ(XicpAlongX(cosine(80.5), 4000).value, 0);
  EXPECT_EQ(XicpAlongX(cosine(80.5), 4000).localizability, Localizability::kNone);
  EXPECT_NEAR(XicpAlongX(cosine(79.5), 4000).value, 4000 * cosine(79.5), 1e-6);
  EXPECT_EQ(XicpAlongX(cosine(45.5), 60).localizability, Localizability::kNone);
  EXPECT_EQ(XicpAlongX(cosine(44.5), 60).localizability, Localizability::kPartial);
}

// Lever arms begin at the points' centroid, here 10 m beside the sensor: about it the points, 3 m
// above and below, hold the turn about y. Seen from the sensor they would hold the one about z. How
// long a lever arm is does not count.
TEST(Degeneracy, XicpTurnsAboutTheCentroid) {
  Constraints wall;
  for (int i = 0; i < 100; ++i) {
    wall.push_back({Vec3(0, 10, i % 2 == 0 ? 3 : -3), Vec3::UnitX()});
  }
  int rotations = 0;
  for (const Judgement& judgement : JudgeXicp(HessianOf(wall), wall)) {
    if (judgement.direction.head<3>().norm() > 0.5) {
      ++rotations;
      const bool about_y = std::abs(judgement.direction[1]) > 0.9;
      EXPECT_NEAR(judgement.value, about_y ? 100 : 0, 1e-9) << judgement.direction.transpose();
    }
  }
  EXPECT_EQ(rotations, 3);
}

// The eigenvalue rule counts points; the condition numbers do not.
TEST(Degeneracy, OnlyTheEigenvalueRuleDependsOnTheNumberOfPoints) {
  const Mat6 room = HessianOf(Room());
  const auto degenerate = [](const std::vector<Judgement>& judgements) {
    return std::count_if(judgements.begin(), judgements.end(), [](const Judgement& judgement) {
      return judgement.localizability == Localizability::kNone;
    });
  };
  EXPECT_EQ(degenerate(JudgeEigenvalues("", "", room, kLoamMappingThreshold)), 0);
  EXPECT_EQ(degenerate(JudgeEigenvalues("", "", 1e-3 * room, kLoamMappingThreshold)), 6);
  EXPECT_EQ(degenerate(JudgeDcreg(room)), degenerate(JudgeDcreg(1e-3 * room)));
}

TEST(Degeneracy, DcregConditionsAreThoseOfTheSchurComplements) {
  Mat6 hessian = Mat6::Zero();
  hessian.diagonal() << 2, 30, 4, 100, 9, 50;
  // Coupling of rotation about y with translation along x: S_R = 30 - 10^2 / 100 = 29,
  // S_t = 100 - 10^2 / 30.
  hessian(1, 3) = hessian(3, 1) = 10;
  const std::vector<Judgement> judgements = JudgeDcreg(hessian);
  EXPECT_NEAR(judgements[0].value, 29.0 / 2, 1e-12);
  EXPECT_NEAR(judgements[1].value, 29.0 / 4, 1e-12);
  EXPECT_NEAR(judgements[2].value, 1, 1e-12);
  EXPECT_NEAR(judgements[3].value, (100 - 100.0 / 30) / 9, 1e-12);
  EXPECT_EQ(judgements[0].localizability, Localizability::kNone);
  EXPECT_EQ(judgements[1].localizability, Localizability::kFull);
  EXPECT_EQ(judgements[3].localizability, Localizability::kNone);
}

// Degenerate is a condition above 10, not one of 10.
TEST(Degeneracy, DcregDecidesAtTen) {
  Mat6 hessian = Mat6::Zero();
  hessian.diagonal() << 2, 20.2, 19, 1, 10, 9;
  const std::vector<Judgement> judgements = JudgeDcreg(hessian);
  EXPECT_NEAR(judgements[0].value, 10.1, 1e-12);
  EXPECT_EQ(judgements[0].threshold, 10);
  EXPECT_EQ(judgements[0].localizability, Localizability::kNone);
  EXPECT_EQ(judgements[3].value, 10);
  EXPECT_EQ(judgements[3].localizability, Localizability::kFull);
}

// The turn about y is coupled by c with a translation along z that has the eigenvalue e, beside one
// of 100: S_R = 30 - c^2 / e = 20 while e counts, and 30 where it is a zero but for rounding.
TEST(Degeneracy, DcregLeavesOutWhatIsSingular) {
  const auto largest_of_rotation = [](double e) {
    Mat6 hessian = Mat6::Zero();
    hessian.diagonal() << 2, 30, 4, 100, 50, e;
    hessian(1, 5) = hessian(5, 1) = std::sqrt(10 * e);
    const std::vector<Judgement> judgements = JudgeDcreg(hessian);
    EXPECT_EQ(judgements[3].localizability, Localizability::kNone) << "along z";
    return 2 * judgements[0].value;
  };
  EXPECT_NEAR(largest_of_rotation(1e-9), 20, 1e-6);
  EXPECT_NEAR(largest_of_rotation(1e-11), 30, 1e-6);
  Mat6 flat = Mat6::Identity();
  flat(5, 5) = 0;
  // No test tells whether negative eigenvalues are set to 0 first: the condition is infinite
  // anyway.
  EXPECT_TRUE(std::isinf(JudgeDcreg(flat)[3].value));
}

// The eigenvalues are the axes' own. A threshold is not yet degenerate.
TEST(Degeneracy, LoamsThresholdsAreTenAndAHundred) {
  Mat6 hessian = Mat6::Zero();
  hessian.diagonal() << 9.9, 10, 10.1, 99, 100, 128;
  int odometry = 0, mapping = 0;
  for (const Judgement& judgement : JudgeDegeneracy(hessian, {})) {
    const bool none = judgement.localizability == Localizability::kNone;
    odometry += judgement.rule == "loam_odometry" && none ? 1 : 0;
    mapping += judgement.rule == "loam_mapping" && none ? 1 : 0;
    EXPECT_NE(judgement.rule, "x_icp") << "there are no pairs";
  }
  EXPECT_EQ(odometry, 1);
  EXPECT_EQ(mapping, 4);
}

// Planes are the closest points' normals, or the patches'. The constraints are the rows of J, so
// that both have one Hessian.
TEST(Degeneracy, PlanesAreNormalsOrPatches) {
  const SE3d T = SE3d::Exp((Vec6() << 0.1, -0.2, 0.5, 0.3, 0.05, -0.02).finished());
  PointCloud target = testing_support::Room(3000, 1, SE3d(), 0.005);
  const PointCloud source = testing_support::Room(3000, 2, T.Inverse(), 0.005);
  EstimateNormals({}, 2, &target);
  for (const char* metric : {"point_to_plane", "planar_to_plane"}) {
    const auto matcher = testing_support::MatcherFor(metric, source, target);
    const Objective objective(metric, *matcher);
    const Matches matches = objective.Match(T, 2);
    const Mat6 hessian = objective.Evaluate(T, matches, 2).sums.Hessian();
    const Constraints constraints = PlaneConstraintsOf(objective, T, matches);
    EXPECT_GT(constraints.size(), 1000U) << metric;
    EXPECT_LE((HessianOf(constraints) - hessian).norm(), 1e-9 * hessian.norm()) << metric;
  }
  const ClosestPointMatcher points(source, target);
  const Objective objective("point_to_point", points);
  EXPECT_TRUE(PlaneConstraintsOf(objective, T, objective.Match(T, 1)).empty());
}

// diag(4, ..) rad^-2 at a lever arm of 2 m is 1 m^-2.
TEST(Degeneracy, EigenvaluesAreInTheStatedLength) {
  Mat6 hessian = Mat6::Identity();
  hessian.topLeftCorner<3, 3>() *= 4;
  const EigenDirections at_2_m = EigenDirectionsOf(hessian, Vec3::Zero(), 2);
  EXPECT_LT((at_2_m.eigenvalues - Vec6::Ones()).norm(), 1e-12);
  EXPECT_NEAR(EigenDirectionsOf(hessian, Vec3::Zero(), 1).eigenvalues[5], 4, 1e-12);
  for (const double length_m : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(EigenDirectionsOf(hessian, Vec3::Zero(), length_m), UsageError) << length_m;
  }
}

// A room that is seen from elsewhere has the same eigenvalues about its own middle, which they are
// not about the origin.
TEST(Degeneracy, EigenvaluesAboutAPointDoNotHangOnTheOrigin) {
  const Constraints room = Room();
  Constraints far = room;
  const Vec3 offset(300, -200, 50);
  for (PlaneConstraint& c : far) {
    c.p_source += offset;
  }
  const EigenDirections here = EigenDirectionsOf(HessianOf(room), Vec3(1, 2, 0.5), 3);
  const EigenDirections there = EigenDirectionsOf(HessianOf(far), offset + Vec3(1, 2, 0.5), 3);
  const EigenDirections elsewhere = EigenDirectionsOf(HessianOf(far), Vec3(1, 2, 0.5), 3);
  EXPECT_LT((here.eigenvalues - there.eigenvalues).norm(), 1e-9 * here.eigenvalues[5]);
  EXPECT_GT(elsewhere.eigenvalues[5], 100 * here.eigenvalues[5]);
  for (int i = 0; i < 6; ++i) {  // A motion d changes the cost by the eigenvalue of its direction.
    const Vec6 xi = AboutPoint(offset + Vec3(1, 2, 0.5), 3).inverse() * there.directions.col(i);
    EXPECT_NEAR(xi.dot(HessianOf(far) * xi), here.eigenvalues[i], 1e-7 * here.eigenvalues[5]);
  }
}

// A simulated highway holds least along itself; all six directions are determined.
TEST(Degeneracy, AHighwayHoldsLeastAlongItself) {
  LidarOptions lidar;
  lidar.azimuth_step_deg = 0.72;
  ScanPair pair = SimulatePair("highway", 1, lidar, 2);
  EstimateNormals({}, 2, &pair.target);
  const ClosestPointMatcher matcher(pair.source, pair.target, {1.0});
  const Objective objective("point_to_plane", matcher);
  const SE3d& T = *pair.T_ground_truth;
  const Matches matches = objective.Match(T, 2);
  const Mat6 hessian = objective.Evaluate(T, matches, 2).sums.Hessian();
  const EigenDirections eigen = EigenDirectionsOf(hessian, Vec3::Zero(), 10);
  EXPECT_GT(std::abs(eigen.directions(kX, 0)), 0.95);
  EXPECT_GT(eigen.eigenvalues[1], 2 * eigen.eigenvalues[0]);
  const Constraints constraints = PlaneConstraintsOf(objective, T, matches);
  EXPECT_EQ(static_cast<long>(constraints.size()), objective.Evaluate(T, matches, 2).n());
  // The constraints are the rows of J.
  EXPECT_LE((HessianOf(constraints) - hessian).norm(), 1e-9 * hessian.norm());
  const std::vector<Judgement> judgements = JudgeDegeneracy(hessian, constraints);
  EXPECT_GT(DegenerateShare(judgements, "dcreg", Vec6::Unit(kX)), 0.9);
  EXPECT_EQ(DegenerateShare(judgements, "loam_mapping", Vec6::Unit(kX)), 0);
}

}  // namespace
}  // namespace icpscape
