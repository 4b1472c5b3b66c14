// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/verdict/named_directions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace icpscape {
namespace {

using Basis = Eigen::Matrix<double, 6, Eigen::Dynamic>;

std::vector<std::string> Names(const Basis& basis) {
  std::vector<std::string> names;
  for (const NamedDirection& named : NameDirections(basis)) {
    names.push_back(named.name);
  }
  return names;
}

Vec6 Unit(double rx, double ry, double rz, double tx, double ty, double tz) {
  return (Vec6() << rx, ry, rz, tx, ty, tz).finished().normalized();
}

TEST(NamedDirections, NamesAxes) {
  const char* const names[] = {"roll", "pitch", "yaw", "along x", "along y", "along z"};
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    EXPECT_THAT(Names(-Vec6::Unit(axis)), testing::ElementsAre(names[axis]));
  }
  EXPECT_TRUE(NameDirections(Basis(6, 0)).empty());
}

// What a plane leaves free, in a basis that is turned among the three.
TEST(NamedDirections, NamesTheAxesOfASubspaceHoweverItIsTurned) {
  const Mat3 R = SE3d::Exp((Vec6() << 0.7, -0.4, 1.1, 0, 0, 0).finished()).R();
  Basis basis = Basis::Zero(6, 3);
  basis.middleRows(2, 3) = R;  // Yaw, x and y.
  EXPECT_THAT(Names(basis), testing::ElementsAre("yaw", "along x", "along y"));
  Basis all = Basis::Zero(6, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    all.col(static_cast<Eigen::Index>(k)) = NameDirections(basis)[k].direction;
  }
  EXPECT_LE((all.transpose() * all - Mat3::Identity()).norm(), 1e-12);
  EXPECT_LE((all * all.transpose() - basis * basis.transpose()).norm(), 1e-12);
}

TEST(NamedDirections, GivesComponentsOfWhatIsNoAxis) {
  EXPECT_THAT(Names(Unit(0, 0, 0, -1, -1, 0)), testing::ElementsAre("along (0.71, 0.71, 0.00)"));
  EXPECT_THAT(Names(Unit(0, 0.6, 0.8, 0, 0, 0)), testing::ElementsAre("about (0.00, 0.60, 0.80)"));
  EXPECT_THAT(Names(Unit(1, 0, 0, 0, 0, 1)),
              testing::ElementsAre("about (1.00, 0.00, 0.00) with along (0.00, 0.00, 1.00)"));
  // An axis beside it keeps its name.
  Basis basis(6, 2);
  basis << Unit(0, 0, 0, 3, 4, 0), Unit(1, 0, 0, 0, 0, 0);
  EXPECT_THAT(Names(basis), testing::ElementsAre("roll", "along (0.60, 0.80, 0.00)"));
}

}  // namespace
}  // namespace icpscape
