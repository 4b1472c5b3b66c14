// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/neighbors/neighborhoods.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <random>

#include "icpscape/neighbors/moved_points.h"
#include "icpscape/neighbors/neighbor_search.h"
#include "tests/support/scenes.h"
#include "tests/support/simd_levels.h"

namespace icpscape {
namespace {

using testing_support::ScopedSimdLevel;

void Append(const Mat3& m, Neighborhoods* out) {
  const std::size_t i = out->size();
  out->Resize(i + 1);
  out->xx[i] = m(0, 0);
  out->xy[i] = m(0, 1);
  out->xz[i] = m(0, 2);
  out->yy[i] = m(1, 1);
  out->yz[i] = m(1, 2);
  out->zz[i] = m(2, 2);
}

Neighborhoods HardMatrices() {
  Neighborhoods out;
  Append(Mat3::Zero(), &out);
  Append(Mat3::Identity(), &out);
  Append(Vec3(3, 1, 2).asDiagonal(), &out);
  Append(Mat3::Ones(), &out);  // Of rank one.
  Append(1e-12 * Mat3::Ones() + Mat3(Vec3(0, 0, 1e-20).asDiagonal()), &out);
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    // Scatter of a rotated box whose sides differ by up to six powers of ten.
    Mat3 A;
    for (int k = 0; k < 9; ++k) {
      A(k / 3, k % 3) = normal(engine);
    }
    const Mat3 Q = Eigen::HouseholderQR<Mat3>(A).householderQ();
    const Vec3 sides(1, std::pow(10, -(i % 7)), std::pow(10, -(i % 5)));
    Append(Q * sides.asDiagonal() * Q.transpose(), &out);
  }
  return out;
}

class PrincipalAxesAt : public testing_support::EverySimdLevel {};
ICPSCAPE_INSTANTIATE_SIMD_LEVELS(PrincipalAxesAt);

// Eigen's iterative solver is the second method.
TEST_P(PrincipalAxesAt, AreThoseOfEigen) {
  const Neighborhoods matrices = HardMatrices();
  PrincipalAxes axes;
  axes.Compute(matrices);
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const Mat3 m = matrices.Products(i);
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(m);
    const double scale = m.norm();
    const Vec3 ours(axes.smallest[i], axes.middle[i], axes.largest[i]);
    EXPECT_LE((ours - eigen.eigenvalues()).norm(), 4e-15 * scale);
    EXPECT_NEAR(axes.Smallest(i).norm(), 1, 1e-14);
    EXPECT_NEAR(axes.Largest(i).norm(), 1, 1e-14);
    EXPECT_LE((m * axes.Smallest(i) - ours[0] * axes.Smallest(i)).norm(), 4e-15 * scale);
    EXPECT_LE((m * axes.Largest(i) - ours[2] * axes.Largest(i)).norm(), 4e-15 * scale);
  }
}

// The sums about the mean, in two passes over the neighbours that a search lists.
TEST_P(PrincipalAxesAt, ProductsAreCenteredOnTheMean) {
  const PointCloud cloud = testing_support::Room(500, 1, SE3d(), 0.01);
  const NeighborSearch search(cloud.View());
  Neighborhoods found;
  search.KNearest(cloud.View(), 7, &found);
  found.CenterProducts();
  for (std::size_t i = 0; i < cloud.size(); i += 10) {
    std::vector<Neighbor> neighbors;
    search.KNearest({cloud.x[i], cloud.y[i], cloud.z[i]}, 7, &neighbors);
    const auto offset = [&](const Neighbor& n) -> Vec3 {
      return cloud.Point(static_cast<std::size_t>(n.index)) - cloud.Point(i);
    };
    Vec3 mean = Vec3::Zero();
    for (const Neighbor& n : neighbors) {
      mean += offset(n) / 7;
    }
    Mat3 scatter = Mat3::Zero();
    for (const Neighbor& n : neighbors) {
      scatter += (offset(n) - mean) * (offset(n) - mean).transpose();
    }
    EXPECT_LE((found.Mean(i) - mean).norm(), 1e-6 * (1 + mean.norm()));
    EXPECT_LE((found.Products(i) - scatter).norm(), 1e-6 * (1 + scatter.norm()));
  }
}

// Up to 31 neighbours within less than 1 m are summed to the last bit of 2^-24 m: nothing rounds.
TEST_P(PrincipalAxesAt, MomentsAreExactTo24Bits) {
  for (const int size : {4, 20, 31}) {
    PointCloud cloud, query;
    testing_support::AddPoint({0, 0, 0}, &query);
    double sum = 0, products = 0;
    for (int i = 0; i < size; ++i) {
      const double x = 0.75 + (2 * i + 1) * 0x1p-24, y = 0.5 - i * 0x1p-24;
      testing_support::AddPoint({x, y, 0}, &cloud);
      ASSERT_EQ(cloud.Point(static_cast<std::size_t>(i)), Vec3(x, y, 0));
      sum += x;
      products += x * y;
    }
    Neighborhoods found;
    NeighborSearch(cloud.View()).KNearest(query.View(), size, &found);
    EXPECT_EQ(found.count[0], size);
    EXPECT_EQ(found.x[0], sum);
    EXPECT_EQ(found.xy[0], products);
  }
}

// However the neighbours are numbered, and with it in which order they are found.
TEST_P(PrincipalAxesAt, MomentsDoNotDependOnTheOrder) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(0, 1);
  PointCloud query;
  testing_support::AddPoint({0, 0, 0}, &query);
  for (const int size : {31, 127, 500}) {
    for (const double radius : {0.99, 1.4, 2.7}) {
      std::vector<Vec3> points;
      for (int i = 0; i < size; ++i) {  // All on one side and nearly as far: the largest sums.
        points.emplace_back(radius * (1 - 1e-3 * unit(engine)), 0.01 * unit(engine), 0);
      }
      Neighborhoods first, found;
      for (int trial = 0; trial < 20; ++trial) {
        PointCloud cloud;
        for (const Vec3& p : points) {
          testing_support::AddPoint(p, &cloud);
        }
        NeighborSearch(cloud.View()).KNearest(query.View(), size, &found);
        first = trial == 0 ? found : first;
        EXPECT_EQ(found.x[0], first.x[0]) << size << " within " << radius;
        EXPECT_EQ(found.xx[0], first.xx[0]) << size << " within " << radius;
        EXPECT_EQ(found.xy[0], first.xy[0]) << size << " within " << radius;
        std::shuffle(points.begin(), points.end(), engine);
      }
    }
  }
}

TEST_P(PrincipalAxesAt, NaNStaysInItsLane) {
  Neighborhoods matrices = HardMatrices();
  PrincipalAxes clean, spoilt;
  clean.Compute(matrices);
  matrices.xy[3] = std::numeric_limits<double>::quiet_NaN();
  spoilt.Compute(matrices);
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    if (i != 3) {
      EXPECT_EQ(clean.smallest[i], spoilt.smallest[i]);
      EXPECT_EQ(clean.Largest(i), spoilt.Largest(i));
    }
  }
}

// Widths, and with them the company in a packet and the path through the tree, differ from level to
// level; results do not.
TEST(SimdLevels, ComputeTheSameBits) {
  const PointCloud cloud = testing_support::Room(5003, 1, SE3d(), 0.01);
  const SE3d T = SE3d::Exp((Vec6() << 0.1, 0.2, 0.3, 1, 2, 3).finished());
  struct Result {
    std::vector<float> moved;
    std::vector<std::int32_t> index;
    std::vector<double> xx, smallest, nx, in_radius;
  };
  std::vector<Result> results;
  for (const SimdLevel level : SupportedSimdLevels()) {
    const ScopedSimdLevel scoped(level);
    Result r;
    MovedPoints moved;
    moved.Move(T, cloud.View());
    r.moved.assign(moved.View().y, moved.View().y + cloud.size());
    const NeighborSearch search(cloud.View());
    r.index.resize(cloud.size());
    std::vector<float> squared_distance(cloud.size());
    moved.Move(SE3d::Exp(Vec6::Constant(0.01)), cloud.View());
    search.Nearest(moved.View(), 1, r.index.data(), squared_distance.data());
    Neighborhoods neighborhoods;
    search.WithinRadius(moved.View(), 0.5F, &neighborhoods);
    r.in_radius = neighborhoods.yz;
    search.KNearest(moved.View(), 20, &neighborhoods);
    neighborhoods.CenterProducts();
    PrincipalAxes axes;
    axes.Compute(neighborhoods);
    r.xx = neighborhoods.xx;
    r.smallest = axes.smallest;
    r.nx = axes.smallest_x;
    results.push_back(r);
  }
  for (const Result& r : results) {
    EXPECT_EQ(r.moved, results[0].moved);
    EXPECT_EQ(r.index, results[0].index);
    EXPECT_EQ(r.in_radius, results[0].in_radius);
    EXPECT_EQ(r.xx, results[0].xx);
    EXPECT_EQ(r.smallest, results[0].smallest);
    EXPECT_EQ(r.nx, results[0].nx);
  }
}

TEST(MovedPoints, AreThoseOfTheTransform) {
  const PointCloud cloud = testing_support::Room(1003, 1);
  const SE3d T = SE3d::Exp((Vec6() << 0.1, -0.2, 0.3, 10, 20, 30).finished());
  MovedPoints moved;
  moved.Move(T, cloud.View());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f expected = (T * cloud.Point(i)).cast<float>();
    EXPECT_EQ(moved.View().x[i], expected.x());
    EXPECT_EQ(moved.View().y[i], expected.y());
    EXPECT_EQ(moved.View().z[i], expected.z());
  }
}

}  // namespace
}  // namespace icpscape
