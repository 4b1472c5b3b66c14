// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/highway.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "icpscape/simulation/random.h"
#include "icpscape/simulation/roadside.h"
#include "icpscape/simulation/vegetation.h"
#include "icpscape/simulation/vehicles.h"

namespace icpscape {
namespace {

constexpr double kHalfLengthM = 150;
constexpr double kLaneM = 3.75;

// From right to left (y, m). Lanes: our right edge at -1.5 lanes; hard shoulder 2.5 m, verge 1.5 m.
constexpr double kOurRight = -1.5 * kLaneM - 2.5;
constexpr double kOurLeft = 1.5 * kLaneM + 0.75;
constexpr double kMedianM = 4;
constexpr double kTheirRight = kOurLeft + kMedianM;  // As seen by us.
constexpr double kTheirLeft = kTheirRight + 0.75 + 3 * kLaneM + 2.5;
constexpr double kVergeM = 1.5;
constexpr double kCuttingM = 2;          // Mean depth of the cutting, ...
constexpr double kCuttingChangeM = 1.2;  // ... and by how much it changes on either side.
constexpr double kGrassM = 0.06;

double OurHeight(double y) { return kHighwayCrossfall * y; }
double TheirHeight(double y) { return OurHeight(kOurLeft) - kHighwayCrossfall * (y - kTheirRight); }

// The ground off the carriageways, without its roughness: behind the verge a shallow ditch, then a
// slope of 1 : 1.5 up to the land around, which rises and falls along the road.
class Verge {
 public:
  explicit Verge(std::uint64_t key) : key_(key) {}

  double Height(double x, double y) const {
    const bool right = y < 0;
    const double road = right ? OurHeight(kOurRight) : TheirHeight(kTheirLeft);
    const double out = std::abs(y - (right ? kOurRight : kTheirLeft));
    const double foot = kVergeM + 0.8;
    if (out < kVergeM) {
      return road - 0.04 * out;
    }
    if (out < foot) {
      return road - 0.04 * kVergeM - 0.25 * std::sin(M_PI * (out - kVergeM) / 0.8);
    }
    const double cutting = kCuttingM + kCuttingChangeM * LatticeNoise(x / 40, right ? 0 : 7, key_);
    return road - 0.04 * kVergeM + std::min(cutting, (out - foot) / 1.5);
  }

 private:
  std::uint64_t key_;
};

// x of grid lines: every 0.4 m near the lidar, where rows of points are that dense, wider beyond.
std::vector<double> GridLines() {
  std::vector<double> lines;
  for (double x = -kHalfLengthM; x < kHalfLengthM; x += std::abs(x) < 45 ? 0.4 : 1.6) {
    lines.push_back(x);
  }
  lines.push_back(kHalfLengthM);
  return lines;
}

void AddStrip(double from, double to, int columns, const Surface& surface, double rough_m,
              double rough_cell_m, std::uint64_t key,
              const std::function<double(double, double)>& height, Mesh* mesh) {
  const std::vector<double> x = GridLines();
  AddPatch(
      static_cast<int>(x.size()) - 1, columns,
      [&](int i, int j) -> Vec3 {
        const double xi = x[static_cast<std::size_t>(i)];
        const double y = from + (to - from) * j / columns;
        return {xi, y,
                height(xi, y) + rough_m * LatticeNoise(xi / rough_cell_m, y / rough_cell_m, key)};
      },
      surface, mesh);
}

double MedianHeight(double y) {
  // A shallow trough between the two carriageways' edges.
  return OurHeight(kOurLeft) - 0.10 * std::sin(M_PI * (y - kOurLeft) / kMedianM);
}

void AddGround(const Verge& verge, std::uint64_t key, Mesh* mesh) {
  const auto ours = [](double, double y) { return OurHeight(y); };
  const auto theirs = [](double, double y) { return TheirHeight(y); };
  const auto median = [](double, double y) { return MedianHeight(y); };
  const auto land = [&](double x, double y) { return verge.Height(x, y); };
  const Surface asphalt{Label::kRoad, Material::kAsphalt};
  const Surface grass{Label::kTerrain, Material::kGrass};
  AddStrip(kOurRight, kOurLeft, 20, asphalt, 0.004, 5, key, ours, mesh);
  AddStrip(kTheirRight, kTheirLeft, 20, asphalt, 0.004, 5, key + 1, theirs, mesh);
  AddStrip(kOurLeft, kTheirRight, 10, grass, kGrassM, 0.5, key + 2, median, mesh);
  AddStrip(kOurRight - 24, kOurRight, 60, grass, kGrassM, 0.5, key + 3, land, mesh);
  AddStrip(kTheirLeft, kTheirLeft + 24, 60, grass, kGrassM, 0.5, key + 4, land, mesh);
}

void AddRails(const Verge& verge, World* world) {
  const auto rail = [&](double y, double z, bool faces_left) {
    const Vec3 a(-kHalfLengthM, y, z);
    const Vec3 b(kHalfLengthM, y, z);
    AddGuardRail(faces_left ? a : b, faces_left ? b : a, world->NextInstance(), &world->standing);
  };
  rail(kOurRight - 0.9, verge.Height(0, kOurRight - 0.9), true);
  rail(kOurLeft + 0.9, MedianHeight(kOurLeft + 0.9), false);
  rail(kTheirRight - 0.9, MedianHeight(kTheirRight - 0.9), true);
  rail(kTheirLeft + 0.9, verge.Height(0, kTheirLeft + 0.9), false);
}

void AddPlants(const Verge& verge, Random* random, World* world) {
  const auto foot = [&](double x, double y) { return Vec3(x, y, verge.Height(x, y)); };
  // Bushes: two of three on the slopes, the rest behind their crest; a row in the median.
  for (const double edge : {kOurRight, kTheirLeft}) {
    const double out = edge < 0 ? -1 : 1;
    for (double x = -kHalfLengthM; x < kHalfLengthM; x += random->Uniform(0.5, 5)) {
      const double distance = random->Chance(0.67) ? random->Uniform(3, 7) : random->Uniform(7, 16);
      AddBush(foot(x, edge + out * distance), random->Uniform(0.4, 1.6), world->NextInstance(),
              random, &world->standing);
    }
    for (double x = -kHalfLengthM; x < kHalfLengthM; x += random->Uniform(12, 45)) {
      AddTree(foot(x, edge + out * random->Uniform(8, 18)), random->Uniform(5, 11),
              world->NextInstance(), random, &world->standing);
    }
  }
  for (double x = -kHalfLengthM; x < kHalfLengthM; x += random->Uniform(2, 9)) {
    const double y = kOurLeft + 0.5 * kMedianM + random->Uniform(-0.3, 0.3);
    AddBush(Vec3(x, y, MedianHeight(y)), random->Uniform(0.3, 0.6), world->NextInstance(), random,
            &world->standing);
  }
}

void AddFurniture(const Verge& verge, Random* random, World* world) {
  // Delineators every 50 m (StVO annex 4) on either side, not in step with each other.
  for (const double y : {kOurRight - 0.5, kTheirLeft + 0.5}) {
    for (double x = -kHalfLengthM + random->Uniform(0, 50); x < kHalfLengthM; x += 50) {
      AddDelineator(Vec3(x, y, verge.Height(x, y)), world->NextInstance(), &world->standing);
    }
  }
  for (const double out : {-1., 1.}) {
    const double edge = out < 0 ? kOurRight : kTheirLeft;
    for (double x = -kHalfLengthM + random->Uniform(0, 60); x < kHalfLengthM;
         x += random->Uniform(50, 110)) {
      const double y = edge + out * 1.6;
      AddSign(Vec3(x, y, verge.Height(x, y)), out < 0 ? M_PI : 0, random->Bits(),
              world->NextInstance(), &world->standing);
    }
  }
}

}  // namespace

World MakeHighway(std::uint64_t key) {
  World world;
  const Verge verge(MixKeys(key, 5));
  AddGround(verge, MixKeys(key, 1), &world.standing);
  AddRails(verge, &world);
  Random plants(MixKeys(key, 2));
  AddPlants(verge, &plants, &world);
  Random furniture(MixKeys(key, 3));
  AddFurniture(verge, &furniture, &world);
  return world;
}

void AddTraffic(double speed_m_s, std::uint64_t key, World* world) {
  Random random(MixKeys(key, 4));
  const auto put = [&](Mesh mesh, double x, double y, double speed) {
    const Mat3 roll =
        Eigen::AngleAxisd(std::atan(kHighwayCrossfall), Vec3::UnitX()).toRotationMatrix();
    world->moving.push_back(
        {std::move(mesh), SE3d(roll, Vec3(x, y, OurHeight(y))), Vec3(speed, 0, 0)});
  };
  // The car's nose is 3 m ahead of the lidar's: half way past.
  put(MakeCar(Label::kMovingCar, world->NextInstance(), &random), 3.0, kLaneM, speed_m_s + 6);
  // Of the lorry we have passed the trailer's rear axles.
  put(MakeLorry(Label::kMovingTruck, world->NextInstance()), 8.0, -kLaneM, 25);
}

}  // namespace icpscape
