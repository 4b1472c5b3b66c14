// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/vehicles.h"

#include <cmath>
#include <vector>

namespace icpscape {
namespace {

// A cross-section of a body: half-widths and heights of sill, waist and roof at one x.
struct Station {
  double x;
  double half_sill, z_sill;
  double half_waist, z_waist;
  double half_top, z_top;
  bool glass_side = false;  // From this station to the next: between waist and top ...
  bool glass_top = false;   // ... and the top itself (windscreens slope along it).
};

void AddBody(const std::vector<Station>& stations, const Surface& paint, const Surface& glass,
             Mesh* mesh) {
  const auto corner = [](const Station& s, int level, double side) -> Vec3 {
    switch (level) {
      case 0:
        return {s.x, side * s.half_sill, s.z_sill};
      case 1:
        return {s.x, side * s.half_waist, s.z_waist};
      default:
        return {s.x, side * s.half_top, s.z_top};
    }
  };
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const Station& a = stations[i];
    const Station& b = stations[i + 1];
    for (const double side : {-1., 1.}) {
      for (int level = 0; level < 2; ++level) {
        mesh->AddQuad(corner(a, level, side), corner(b, level, side), corner(b, level + 1, side),
                      corner(a, level + 1, side), level == 1 && a.glass_side ? glass : paint);
      }
    }
    mesh->AddQuad(corner(a, 2, -1), corner(b, 2, -1), corner(b, 2, 1), corner(a, 2, 1),
                  a.glass_top ? glass : paint);
    mesh->AddQuad(corner(a, 0, -1), corner(b, 0, -1), corner(b, 0, 1), corner(a, 0, 1), paint);
  }
  for (const Station& end : {stations.front(), stations.back()}) {
    for (int level = 0; level < 2; ++level) {
      mesh->AddQuad(corner(end, level, -1), corner(end, level, 1), corner(end, level + 1, 1),
                    corner(end, level + 1, -1), paint);
    }
  }
}

// A wheel standing at (x, y), outer face towards y's side.
void AddWheel(double x, double y, double radius, double width, std::uint16_t instance, Label label,
              Mesh* mesh) {
  const double side = y > 0 ? 1 : -1;
  const Vec3 outer(x, y, radius);
  const Vec3 inner(x, y - side * width, radius);
  AddFrustum(inner, outer, radius, radius, 20, {label, Material::kRubber, instance}, mesh);
  // The rim, a little proud of the tyre.
  AddFrustum(outer, outer + Vec3(0, side * 0.01, 0), 0.65 * radius, 0.6 * radius, 16,
             {label, Material::kSteel, instance}, mesh);
}

}  // namespace

Mesh MakeCar(Label label, std::uint16_t instance, Random* random) {
  const int shape = random->Index(3);  // 0 saloon, 1 estate, 2 hatchback
  const bool dark = random->Chance(0.4);
  const double length = shape == 2 ? random->Uniform(0.9, 0.95) : random->Uniform(0.98, 1.04);
  const double height = random->Uniform(0.98, 1.08);
  const Surface paint{label, dark ? Material::kDarkPaint : Material::kLightPaint, instance};
  const Surface glass{label, Material::kGlass, instance};

  constexpr double kAxle = 1.33;
  constexpr double kArch = 0.36;
  constexpr double kArchTop = 0.64;
  std::vector<Station> s = {
      {2.28, 0.50, 0.32, 0.60, 0.50, 0.55, 0.62},
      {2.18, 0.72, 0.24, 0.80, 0.52, 0.72, 0.70},
      {1.95, 0.82, 0.20, 0.88, 0.58, 0.80, 0.78},
      {kAxle + kArch, 0.84, 0.20, 0.90, 0.66, 0.78, 0.84},
      {kAxle + kArch - 0.02, 0.86, kArchTop - 0.05, 0.90, 0.68, 0.78, 0.84},
      {kAxle + 0.18, 0.87, kArchTop, 0.90, 0.70, 0.77, 0.88},
      {kAxle - 0.18, 0.87, kArchTop, 0.91, 0.72, 0.76, 0.92},
      {kAxle - kArch, 0.86, kArchTop - 0.05, 0.91, 0.74, 0.75, 0.95},
      {kAxle - kArch - 0.02, 0.84, 0.20, 0.91, 0.84, 0.74, 0.96, true, true},
      {0.20, 0.84, 0.20, 0.91, 0.90, 0.60, 1.40, true, false},
      {-0.45, 0.84, 0.20, 0.91, 0.92, 0.60, 1.44, true, false},
      {-kAxle + kArch + 0.02, 0.84, 0.20, 0.91, 0.93, 0.60, 1.43, true, false},
      {-kAxle + kArch, 0.86, kArchTop - 0.05, 0.91, 0.93, 0.60, 1.43, true, shape == 0},
  };
  const std::vector<Station> tails[3] = {
      {{-kAxle, 0.87, kArchTop, 0.91, 0.94, 0.66, 1.25, true, true},
       {-kAxle - kArch + 0.02, 0.86, kArchTop - 0.05, 0.90, 0.92, 0.72, 1.02},
       {-kAxle - kArch, 0.84, 0.22, 0.90, 0.92, 0.72, 1.02},
       {-2.15, 0.80, 0.26, 0.86, 0.90, 0.70, 0.99},
       {-2.28, 0.70, 0.34, 0.78, 0.80, 0.66, 0.94}},
      {{-kAxle, 0.87, kArchTop, 0.91, 0.94, 0.60, 1.42, true, false},
       {-kAxle - kArch + 0.02, 0.86, kArchTop - 0.05, 0.90, 0.95, 0.60, 1.40, true, false},
       {-kAxle - kArch, 0.84, 0.22, 0.90, 0.95, 0.60, 1.40, true, true},
       {-2.15, 0.80, 0.26, 0.86, 0.96, 0.66, 1.06},
       {-2.28, 0.70, 0.34, 0.80, 0.80, 0.68, 0.98}},
      {{-kAxle, 0.87, kArchTop, 0.91, 0.94, 0.60, 1.38, true, false},
       {-kAxle - kArch + 0.02, 0.86, kArchTop - 0.05, 0.90, 0.95, 0.60, 1.34, true, true},
       {-kAxle - kArch, 0.84, 0.22, 0.90, 0.95, 0.60, 1.33, true, true},
       {-2.05, 0.80, 0.26, 0.84, 0.92, 0.68, 1.02},
       {-2.14, 0.70, 0.34, 0.80, 0.80, 0.68, 0.95}}};
  s.insert(s.end(), tails[shape].begin(), tails[shape].end());
  for (Station& station : s) {
    station.x *= length;
    station.z_waist *= height;
    station.z_top *= height;
  }
  Mesh mesh;
  AddBody(s, paint, glass, &mesh);
  for (const double x : {kAxle * length, -kAxle * length}) {
    for (const double y : {-0.88, 0.88}) {
      AddWheel(x, y, 0.31, 0.20, instance, label, &mesh);
    }
  }
  for (const double side : {-1., 1.}) {
    AddBox(Placement(0.72 * length, side * 0.97, 0.98 * height, 0), Vec3(-0.06, -0.09, -0.07),
           Vec3(0.06, 0.09, 0.07), paint, &mesh);
  }
  return mesh;
}

Mesh MakeLorry(Label label, std::uint16_t instance) {
  const Surface paint{label, Material::kLightPaint, instance};
  const Surface glass{label, Material::kGlass, instance};
  const Surface steel{label, Material::kSteel, instance};
  const Surface tarpaulin{label, Material::kTarpaulin, instance};
  Mesh mesh;
  const SE3d here;
  // Cab: bumper, sloping windscreen, air deflector.
  AddBody({{8.25, 1.10, 0.35, 1.20, 1.55, 1.18, 1.70, false, false},
           {8.20, 1.24, 0.35, 1.25, 1.60, 1.22, 1.75, false, true},
           {7.95, 1.25, 0.35, 1.25, 1.65, 1.18, 2.85, true, false},
           {7.10, 1.25, 1.05, 1.25, 1.70, 1.18, 3.30, true, false},
           {6.75, 1.25, 1.05, 1.25, 1.75, 1.18, 3.55, false, false},
           {6.00, 1.25, 0.80, 1.25, 1.75, 1.18, 3.80, false, false}},
          paint, glass, &mesh);
  // Frame, fifth wheel, tank between the axles.
  AddBox(here, Vec3(-8.1, -0.45, 0.85), Vec3(6.0, 0.45, 1.15), steel, &mesh);
  AddFrustum(Vec3(5.6, 0.95, 0.70), Vec3(4.5, 0.95, 0.70), 0.30, 0.30, 16, steel, &mesh);
  AddFrustum(Vec3(5.6, -0.95, 0.70), Vec3(4.5, -0.95, 0.70), 0.30, 0.30, 16, steel, &mesh);
  // Trailer: tarpaulins bulge between the posts by some centimetres.
  constexpr double kFront = 5.35;
  constexpr double kRear = -8.25;
  constexpr int kBays = 8;
  for (const double side : {-1., 1.}) {
    AddPatch(
        kBays * 4, 8,
        [&](int i, int j) -> Vec3 {
          const double along = i / 4.;
          const double bulge =
              0.03 * std::sin(M_PI * (along - std::floor(along))) * std::sin(M_PI * j / 8.);
          return {kFront + (kRear - kFront) * along / kBays, side * (1.24 + bulge),
                  1.15 + 2.85 * j / 8.};
        },
        tarpaulin, &mesh);
  }
  AddBox(here, Vec3(kRear, -1.24, 3.98), Vec3(kFront, 1.24, 4.0), tarpaulin, &mesh);
  AddBox(here, Vec3(kRear, -1.24, 1.13), Vec3(kFront, 1.24, 1.17), steel, &mesh);
  AddBox(here, Vec3(kFront - 0.05, -1.24, 1.15), Vec3(kFront, 1.24, 4.0), paint, &mesh);
  // Rear doors with their locking bars, bumper and lights.
  AddBox(here, Vec3(kRear, -1.24, 1.15), Vec3(kRear + 0.05, 1.24, 4.0), paint, &mesh);
  for (const double y : {-0.8, -0.25, 0.25, 0.8}) {
    AddFrustum(Vec3(kRear - 0.04, y, 1.2), Vec3(kRear - 0.04, y, 3.95), 0.02, 0.02, 8, steel,
               &mesh);
  }
  AddBox(here, Vec3(kRear, -1.2, 0.45), Vec3(kRear + 0.12, 1.2, 0.60), steel, &mesh);
  // Side guards.
  for (const double side : {-1., 1.}) {
    for (const double z : {0.55, 0.85}) {
      AddBox(here, Vec3(-2.9, side * 1.22 - 0.02, z - 0.06),
             Vec3(3.2, side * 1.22 + 0.02, z + 0.06), steel, &mesh);
    }
  }
  for (const double x : {6.95, 3.85, -3.6, -4.91, -6.22}) {
    for (const double y : {-1.25, 1.25}) {
      AddWheel(x, y, 0.50, 0.35, instance, label, &mesh);
    }
  }
  for (const double side : {-1., 1.}) {
    AddBox(Placement(7.9, side * 1.42, 2.3, 0), Vec3(-0.08, -0.12, -0.35), Vec3(0.08, 0.12, 0.35),
           paint, &mesh);
  }
  return mesh;
}

}  // namespace icpscape
