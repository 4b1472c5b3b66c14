// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/vegetation.h"

#include <cmath>

namespace icpscape {
namespace {

Vec3 UnitVector(Random* random) {
  Vec3 v;
  double squared = 0;
  do {
    v = Vec3(random->Uniform(-1, 1), random->Uniform(-1, 1), random->Uniform(-1, 1));
    squared = v.squaredNorm();
  } while (squared > 1 || squared < 1e-4);
  return v / std::sqrt(squared);
}

// A leaf cluster: a small quadrilateral turned at random.
void AddLeaf(const Vec3& p, double size_m, const Surface& surface, Random* random, Mesh* mesh) {
  const Vec3 u = UnitVector(random);
  const Vec3 v = u.cross(UnitVector(random));
  const double half = size_m * random->Uniform(0.3, 0.7);
  mesh->AddQuad(p - half * u, p - half * v, p + half * u, p + half * v, surface);
}

// Leaf clusters in an ellipsoid, denser towards its surface, where the light is.
void AddLeaves(const Vec3& centre, const Vec3& radii, int count, double size_m,
               const Surface& surface, Random* random, Mesh* mesh) {
  for (int i = 0; i < count; ++i) {
    const double depth = std::sqrt(std::sqrt(random->Uniform(0.05, 1)));
    const Vec3 p = centre + depth * radii.cwiseProduct(UnitVector(random));
    AddLeaf(p, size_m, surface, random, mesh);
  }
}

}  // namespace

void AddTree(const Vec3& foot, double height_m, std::uint16_t instance, Random* random,
             Mesh* mesh) {
  const Surface bark{Label::kTrunk, Material::kWood, instance};
  const Surface leaves{Label::kVegetation, Material::kFoliage, instance};
  const double crown = height_m * random->Uniform(0.24, 0.32);  // Half-width.
  const double first_bough = height_m * random->Uniform(0.22, 0.32);
  const Vec3 lean(random->Uniform(-0.03, 0.03), random->Uniform(-0.03, 0.03), 1);
  const double girth = 0.02 * height_m;
  AddFrustum(foot, foot + first_bough * lean, 1.2 * girth, girth, 12, bark, mesh);
  const Vec3 fork = foot + first_bough * lean;
  const Vec3 centre = foot + 0.62 * height_m * lean;
  AddFrustum(fork, foot + 0.85 * height_m * lean, girth, 0.3 * girth, 8, bark, mesh);
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * M_PI * (i + random->Uniform(0, 0.6)) / 5;
    const Vec3 tip = fork + Vec3(0.7 * crown * std::cos(angle), 0.7 * crown * std::sin(angle),
                                 height_m * random->Uniform(0.1, 0.35));
    AddFrustum(fork, tip, 0.5 * girth, 0.15 * girth, 6, bark, mesh);
  }
  const int clusters = static_cast<int>(90 * crown * crown * height_m / 4);
  AddLeaves(centre, Vec3(crown, crown, 0.38 * height_m), std::min(clusters, 4000), 0.28, leaves,
            random, mesh);
}

void AddBush(const Vec3& foot, double radius_m, std::uint16_t instance, Random* random,
             Mesh* mesh) {
  const int clusters = static_cast<int>(220 * radius_m * radius_m);
  AddLeaves(foot + Vec3(0, 0, 0.55 * radius_m), Vec3(radius_m, radius_m, 0.7 * radius_m), clusters,
            0.2, {Label::kVegetation, Material::kFoliage, instance}, random, mesh);
}

void AddHedge(const Vec3& a, const Vec3& b, double thickness_m, double height_m,
              std::uint16_t instance, std::uint64_t key, Mesh* mesh) {
  const Surface leaves{Label::kVegetation, Material::kFoliage, instance};
  const Vec3 along = (b - a).normalized();
  const Vec3 across = Vec3::UnitZ().cross(along);
  const double length = (b - a).norm();
  constexpr double kCellM = 0.15;
  constexpr double kTwigsPerSquareMetre = 25;
  const int columns = std::max(1, static_cast<int>(length / kCellM));
  // The outline of a section: up one face, over the top, down the other.
  const int up = std::max(1, static_cast<int>(height_m / kCellM));
  const int over = std::max(1, static_cast<int>(thickness_m / kCellM));
  const int rows = 2 * up + over;
  const auto point = [&](int i, int j) -> Vec3 {
    const double s = length * j / columns;
    double side = 0.5;
    double z = height_m;
    if (i < up) {
      z = height_m * i / up;
    } else if (i <= up + over) {
      side = 0.5 - static_cast<double>(i - up) / over;
    } else {
      side = -0.5;
      z = height_m * (rows - i) / up;
    }
    const double rough = 0.09 * LatticeNoise(i * 0.9, j * 0.9, key);
    const double offset = thickness_m * side + (side < 0 ? -rough : rough);
    return a + s * along + offset * across +
           Vec3(0, 0, z + (i >= up && i <= up + over ? rough : 0));
  };
  AddPatch(rows, columns, point, leaves, mesh);
  // Twigs stand out of the faces by up to 15 cm.
  Random random(key);
  const int twigs = static_cast<int>(kTwigsPerSquareMetre * 2 * length * height_m);
  for (int i = 0; i < twigs; ++i) {
    const double side = random.Chance(0.5) ? 1 : -1;
    const Vec3 p = a + random.Uniform(0, length) * along +
                   side * (0.5 * thickness_m + random.Uniform(0, 0.15)) * across +
                   Vec3(0, 0, random.Uniform(0.1, height_m));
    AddLeaf(p, 0.12, leaves, &random, mesh);
  }
}

}  // namespace icpscape
