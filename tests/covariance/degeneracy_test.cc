// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/degeneracy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/matching/closest_point_matcher.h"
#include "icpscape/minimizer/minimizer.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulated_sequence.h"

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
double DegenerateShare(const std::vector<Verdict>& verdicts, const std::string& rule,
                       const Vec6& direction) {
  double share = 0;
  for (const Verdict& verdict : verdicts) {
    if (verdict.rule == rule && verdict.localizability == Localizability::kNone) {
      share += std::pow(verdict.direction.dot(direction.normalized()), 2);
    }
  }
  return share;
}

// Every rule must call these axes degenerate, and no others.
void ExpectDegenerate(const Constraints& scene, const std::vector<int>& axes) {
  const std::vector<Verdict> verdicts = JudgeDegeneracy(HessianOf(scene), scene);
  ASSERT_EQ(verdicts.size(), 24U);
  for (const char* rule : {"loam_odometry", "loam_mapping", "x_icp", "dcreg"}) {
    for (int axis = 0; axis < 6; ++axis) {
      const bool expected = std::find(axes.begin(), axes.end(), axis) != axes.end();
      EXPECT_NEAR(DegenerateShare(verdicts, rule, Vec6::Unit(axis)), expected ? 1 : 0, 1e-6)
          << rule << ", axis " << axis;
    }
  }
}

constexpr int kRoll = 0, kYaw = 2, kX = 3, kY = 4;

TEST(Degeneracy, ARoomHasNone) { ExpectDegenerate(Room(), {}); }
TEST(Degeneracy, ACorridorSlidesAlong) { ExpectDegenerate(Corridor(), {kX}); }
TEST(Degeneracy, APlaneSlidesBothWaysAndTurns) { ExpectDegenerate(Plane(), {kX, kY, kYaw}); }
TEST(Degeneracy, ATunnelSlidesAlongAndRolls) { ExpectDegenerate(Cylinder(), {kX, kRoll}); }

// What X-ICP sums, by hand: m points whose normals are along x each contribute 1 to x and nothing
// to y and z.
TEST(Degeneracy, XicpCountsContributions) {
  const auto category = [](int points) {
    Constraints wall;
    for (int i = 0; i < points; ++i) {
      wall.push_back({Vec3(5, 0.1 * i, 0.2 * (i % 7)), Vec3::UnitX()});
    }
    for (const Verdict& verdict : JudgeXicp(HessianOf(wall), wall)) {
      if (std::abs(verdict.direction[kX]) > 0.9) {
        EXPECT_NEAR(verdict.value, points, 1e-9);
        return verdict.localizability;
      }
    }
    ADD_FAILURE() << "no direction along x";
    return Localizability::kNone;
  };
  EXPECT_EQ(category(34), Localizability::kNone);
  EXPECT_EQ(category(36), Localizability::kPartial);
  EXPECT_EQ(category(179), Localizability::kPartial);
  EXPECT_EQ(category(181), Localizability::kFull);
  // Normals 85 degrees from x are noise; 60 degrees from it they are weak: only L_c counts them.
  const auto tilted = [](double angle_deg, int points) {
    Constraints walls;
    for (int i = 0; i < points; ++i) {
      const double sign = i % 2 == 0 ? 1 : -1;
      const double angle = sign * angle_deg * M_PI / 180;
      walls.push_back({Vec3(5, 0.1 * i, 0), Vec3(std::cos(angle), std::sin(angle), 0)});
    }
    for (const Verdict& verdict : JudgeXicp(HessianOf(walls), walls)) {
      if (std::abs(verdict.direction[kX]) > 0.9) {
        return verdict;
      }
    }
    ADD_FAILURE() << "no direction along x";
    return Verdict{};
  };
  EXPECT_EQ(tilted(85, 4000).value, 0);
  EXPECT_EQ(tilted(85, 4000).localizability, Localizability::kNone);
  EXPECT_NEAR(tilted(60, 400).value, 200, 1e-9);
  EXPECT_EQ(tilted(60, 400).localizability, Localizability::kPartial);
  EXPECT_EQ(tilted(60, 520).localizability, Localizability::kFull);
}

// Lever arms begin at the points' centroid, here 10 m beside the sensor: about it the points, 1 m
// above and below, hold the turn about y. Seen from the sensor they would hold the one about z.
TEST(Degeneracy, XicpTurnsAboutTheCentroid) {
  Constraints wall;
  for (int i = 0; i < 100; ++i) {
    wall.push_back({Vec3(0, 10, i % 2 == 0 ? 1 : -1), Vec3::UnitX()});
  }
  for (const Verdict& verdict : JudgeXicp(HessianOf(wall), wall)) {
    if (verdict.direction.head<3>().norm() > 0.5) {
      const bool about_y = std::abs(verdict.direction[1]) > 0.9;
      EXPECT_NEAR(verdict.value, about_y ? 100 : 0, 1e-9) << verdict.direction.transpose();
    }
  }
}

// The eigenvalue rule counts points; the condition numbers do not.
TEST(Degeneracy, OnlyTheEigenvalueRuleDependsOnTheNumberOfPoints) {
  const Mat6 room = HessianOf(Room());
  const auto degenerate = [](const std::vector<Verdict>& verdicts) {
    return std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& verdict) {
      return verdict.localizability == Localizability::kNone;
    });
  };
  EXPECT_EQ(degenerate(JudgeEigenvalues("", "", room, kLoamMappingThreshold)), 0);
  EXPECT_EQ(degenerate(JudgeEigenvalues("", "", 1e-3 * room, kLoamMappingThreshold)), 6);
  EXPECT_EQ(degenerate(JudgeDcreg(room)), degenerate(JudgeDcreg(1e-3 * room)));
}

// Two walls at x = 4 and y = 0, points given by hand: H_tt = diag(2, 1, .), one row each.
TEST(Degeneracy, DcregConditionsAreThoseOfTheSchurComplements) {
  Mat6 hessian = Mat6::Zero();
  hessian.diagonal() << 2, 30, 4, 100, 9, 50;
  // Coupling of rotation about y with translation along x: S_R = 30 - 10^2 / 100 = 29,
  // S_t = 100 - 10^2 / 30.
  hessian(1, 3) = hessian(3, 1) = 10;
  const std::vector<Verdict> verdicts = JudgeDcreg(hessian);
  EXPECT_NEAR(verdicts[0].value, 29.0 / 2, 1e-12);
  EXPECT_NEAR(verdicts[1].value, 29.0 / 4, 1e-12);
  EXPECT_NEAR(verdicts[2].value, 1, 1e-12);
  EXPECT_NEAR(verdicts[3].value, (100 - 100.0 / 30) / 9, 1e-12);
  EXPECT_EQ(verdicts[0].localizability, Localizability::kNone);
  EXPECT_EQ(verdicts[1].localizability, Localizability::kFull);
  EXPECT_EQ(verdicts[3].localizability, Localizability::kNone);
}

// diag(4, ..) rad^-2 at a lever arm of 2 m is 1 m^-2.
TEST(Degeneracy, EigenvaluesAreInTheStatedLength) {
  Mat6 hessian = Mat6::Identity();
  hessian.topLeftCorner<3, 3>() *= 4;
  const EigenDirections at_2_m = EigenDirectionsOf(hessian, 2);
  EXPECT_LT((at_2_m.eigenvalues - Vec6::Ones()).norm(), 1e-12);
  EXPECT_NEAR(EigenDirectionsOf(hessian, 1).eigenvalues[5], 4, 1e-12);
  EXPECT_THROW(EigenDirectionsOf(hessian, 0), UsageError);
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
  const EigenDirections eigen = EigenDirectionsOf(hessian, 10);
  EXPECT_GT(std::abs(eigen.directions(kX, 0)), 0.95);
  EXPECT_GT(eigen.eigenvalues[1], 2 * eigen.eigenvalues[0]);
  const Constraints constraints = PlaneConstraintsOf(objective, T, matches);
  EXPECT_EQ(static_cast<long>(constraints.size()), objective.Evaluate(T, matches, 2).n());
  // The constraints are the rows of J.
  EXPECT_LE((HessianOf(constraints) - hessian).norm(), 1e-9 * hessian.norm());
  const std::vector<Verdict> verdicts = JudgeDegeneracy(hessian, constraints);
  EXPECT_GT(DegenerateShare(verdicts, "dcreg", Vec6::Unit(kX)), 0.9);
  EXPECT_EQ(DegenerateShare(verdicts, "loam_mapping", Vec6::Unit(kX)), 0);
}

}  // namespace
}  // namespace icpscape
