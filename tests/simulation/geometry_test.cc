// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "icpscape/simulation/buildings.h"
#include "icpscape/simulation/mesh.h"
#include "icpscape/simulation/random.h"
#include "icpscape/simulation/ray_caster.h"
#include "icpscape/simulation/vehicles.h"

namespace icpscape {
namespace {

Eigen::AlignedBox3d Bounds(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    box.extend(mesh.Vertex(i));
  }
  return box;
}

TEST(RayCaster, HitsATriangleAtAKnownPlace) {
  Mesh mesh;
  mesh.AddTriangle(Vec3(3, -1, -1), Vec3(3, 1, -1), Vec3(3, 0, 1),
                   {Label::kPole, Material::kSteel, 9});
  const RayCaster caster(mesh);
  RayHit hit;
  ASSERT_TRUE(caster.Cast(Vec3::Zero(), Vec3::UnitX(), 10, &hit));
  EXPECT_FLOAT_EQ(static_cast<float>(hit.range_m), 3);
  EXPECT_NEAR(hit.cos_incidence, 1, 1e-6);
  EXPECT_EQ(hit.surface.PointLabel(), 80 + 9 * 65536);
  const Vec3 slanted = Vec3(3, 0, 0.75).normalized();
  ASSERT_TRUE(caster.Cast(Vec3::Zero(), slanted, 10, &hit));
  EXPECT_NEAR(hit.range_m, std::hypot(3, 0.75), 1e-5);
  EXPECT_NEAR(hit.cos_incidence, 3 / std::hypot(3, 0.75), 1e-6);
  EXPECT_FALSE(caster.Cast(Vec3::Zero(), Vec3::UnitX(), 2.9, &hit));  // Too far.
  EXPECT_FALSE(caster.Cast(Vec3::Zero(), -Vec3::UnitX(), 10, &hit));  // Behind.
  EXPECT_FALSE(caster.Cast(Vec3(0, 2, 0), Vec3::UnitX(), 10, &hit));  // Beside.
  EXPECT_TRUE(caster.Cast(Vec3(6, 0, 0), -Vec3::UnitX(), 10, &hit));  // Both sides are solid.
}

TEST(RayCaster, EmptyMeshHasNoHits) {
  RayHit hit;
  EXPECT_FALSE(RayCaster(Mesh()).Cast(Vec3::Zero(), Vec3::UnitX(), 100, &hit));
}

TEST(Mesh, PrimitivesHaveTheirSizeAndAreClosed) {
  const Surface surface{Label::kOtherObject, Material::kWood, 1};
  Mesh box;
  AddBox(Placement(10, 0, 0, M_PI / 2), Vec3(0, 0, 0), Vec3(2, 1, 3), surface, &box);
  EXPECT_TRUE(Bounds(box).min().isApprox(Vec3(9, 0, 0), 1e-6)) << Bounds(box).min().transpose();
  EXPECT_TRUE(Bounds(box).max().isApprox(Vec3(10, 2, 3), 1e-6)) << Bounds(box).max().transpose();
  Mesh drum;
  AddFrustum(Vec3(0, 0, 1), Vec3(0, 0, 4), 0.5, 0.5, 32, surface, &drum);
  EXPECT_NEAR(Bounds(drum).sizes().x(), 1, 1e-6);
  EXPECT_NEAR(Bounds(drum).sizes().z(), 3, 1e-6);
  // From inside a closed body no ray escapes.
  for (const Mesh& mesh : {box, drum}) {
    const RayCaster caster(mesh);
    const Vec3 centre = Bounds(mesh).center();
    Random random(3);
    for (int i = 0; i < 200; ++i) {
      const Vec3 direction(random.Normal(), random.Normal(), random.Normal());
      RayHit hit;
      EXPECT_TRUE(caster.Cast(centre, direction.normalized(), 100, &hit));
    }
  }
}

TEST(Vehicles, HaveTheSizesOfRealOnes) {
  for (std::uint64_t key = 0; key < 20; ++key) {
    Random random(key * 1000);
    const Eigen::AlignedBox3d car = Bounds(MakeCar(Label::kCar, 1, &random));
    EXPECT_GT(car.sizes().x(), 3.8);
    EXPECT_LT(car.sizes().x(), 4.9);
    EXPECT_NEAR(car.sizes().y(), 2.1, 0.1);  // Over the mirrors.
    EXPECT_NEAR(car.sizes().z(), 1.48, 0.1);
    EXPECT_NEAR(car.min().z(), 0, 1e-6);  // The wheels stand.
  }
  const Eigen::AlignedBox3d lorry = Bounds(MakeLorry(Label::kMovingTruck, 1));
  EXPECT_NEAR(lorry.sizes().x(), 16.5, 0.1);
  EXPECT_NEAR(lorry.sizes().z(), 4.0, 0.01);
  EXPECT_NEAR(lorry.min().z(), 0, 1e-6);
}

TEST(House, HasRecessedWindows) {
  Mesh mesh;
  Random random(4);
  AddHouse({12, 10, 2}, SE3d(), 1, &random, &mesh);
  const RayCaster caster(mesh);
  int on_wall = 0;
  int behind = 0;
  int before = 0;
  for (double x = 0.5; x < 11.5; x += 0.05) {
    RayHit hit;
    ASSERT_TRUE(caster.Cast(Vec3(x, -20, 1.7), Vec3::UnitY(), 100, &hit)) << x;
    const double y = hit.range_m - 20;
    on_wall += std::abs(y) < 1e-3 ? 1 : 0;
    behind += y > 0.1 ? 1 : 0;
    before += y < -0.01 ? 1 : 0;
  }
  EXPECT_GT(on_wall, 60);
  EXPECT_GT(behind, 40);
  EXPECT_EQ(on_wall + behind + before, 220);
}

TEST(Random, IsUniformAndNearlyNormal) {
  Random random(11);
  double sum = 0;
  double squares = 0;
  double uniform = 0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Normal();
    sum += x;
    squares += x * x;
    uniform += random.Uniform(2, 4);
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.015);
  EXPECT_NEAR(squares / kDraws, 1, 0.02);
  EXPECT_NEAR(uniform / kDraws, 3, 0.01);
  EXPECT_NE(MixKeys(1, 2, 3), MixKeys(1, 3, 2));
  EXPECT_EQ(LatticeNoise(2, 3, 5), LatticeNoise(2, 3, 5));
  EXPECT_NEAR(LatticeNoise(1.999999, 3.2, 5), LatticeNoise(2.000001, 3.2, 5), 1e-4);
}

}  // namespace
}  // namespace icpscape
